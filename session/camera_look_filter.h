#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "base/image.h"
#include "compositor/picture/camera_look.h"
#include "scene/marker_reflectance.h"

namespace pleinair::session {

/// Blur and grain of a camera's frames, measured on the marker now and then: both change slowly.
class CameraLookFilter {
 public:
  /// The camera's look after this frame where it was measured anew, the median of the last
  /// measurements; nothing: it is as it was.
  std::optional<compositor::CameraLook> Update(ImageView<const std::uint8_t> rgb,
                                               const CameraModel& camera,
                                               const Transform<Camera, Marker>& camera_from_marker,
                                               const scene::MarkerReflectance& marker,
                                               const CameraResponse& response);

 private:
  int frames_to_next_ = 0;  // Until it is measured again.
  std::deque<compositor::CameraLook> recent_;
};

}  // namespace pleinair::session
