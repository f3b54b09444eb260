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

/// Measures our tracker on a recording with ground truth (recording_truth.h), and the configured
/// peers that can decode its marker.
/// The reference marker is the scene's; if the scene does not name one, the marker detected most
/// often. Ground truth in another frame of reference is aligned with our trajectory; the errors are
/// then the residuals of the alignment.
/// Frames without a true pose, or with the marker behind the camera, are ignored. If the scene
/// names the marker, observations of other numbers count as false. Otherwise other markers are
/// ignored.
/// Errors (input): those of OpenRecording and Next(), a scene without the marker's size, no marker
/// detected. Also a ground truth that is missing or has no pose at any frame.
Result<std::vector<accuracy::FrameRecord>> MeasureRecording(const std::string& path,
                                                            std::int64_t first_frame,
                                                            const AccuracyConfig& config);

/// Reads one frame of a recording; nothing if it cannot be read.
std::optional<GreyImage> RecordedPicture(const std::string& path, std::int64_t index);

}  // namespace pleinair::app
