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

/// Measures our tracker on a recording whose folder has a truth.tum: the camera in the marker's
/// frame at each frame's time (docs/formats.md). Frames without a true pose, or in which the marker
/// is behind the camera, are left out; a sighting of another number than the scene's marker is
/// false. Errors (input): what OpenRecording refuses or Next() fails at, a scene that does not say
/// which marker, a truth that is missing or has no pose at any frame.
Result<std::vector<accuracy::FrameRecord>> MeasureRecording(const std::string& path,
                                                            std::int64_t first_frame,
                                                            const AccuracyConfig& config);

/// One frame of a recording; nothing where it cannot be read.
std::optional<GreyImage> RecordedPicture(const std::string& path, std::int64_t index);

}  // namespace pleinair::app
