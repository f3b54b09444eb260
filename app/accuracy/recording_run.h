#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "app/accuracy/accuracy_config.h"
#include "base/error.h"
#include "base/image.h"

namespace pleinair::app {

/// Measures our tracker on a recording with ground truth (recording_truth.h), and the peers of the
/// configuration that can read its marker's print. The marker is the scene's; where that does not
/// say which, the one that is found most often. Truth in a frame of its author's own is told in the
/// marker's by aligning it with the path that we find: what is measured then is what is left.
/// Frames without a true pose, or in which the marker is behind the camera, are left out. A
/// observation of another number than the scene's marker is false; where the scene does not say
/// which, others are not looked at. Errors (input): what OpenRecording refuses or Next() fails at,
/// a scene that does not say how large the marker is, a truth that is missing or has no pose at any
/// frame, no marker found.
Result<std::vector<accuracy::FrameRecord>> MeasureRecording(const std::string& path,
                                                            std::int64_t first_frame,
                                                            const AccuracyConfig& config);

/// One frame of a recording; nothing where it cannot be read.
std::optional<GreyImage> RecordedPicture(const std::string& path, std::int64_t index);

}  // namespace pleinair::app
