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

/// Measures blur and noise of a camera's frames on the marker in regular intervals: both change
/// slowly.
class CameraLookFilter {
 public:
  /// Returns the median of the last measurements if this frame was measured. Returns nothing if the
  /// look is unchanged. `lens` and `motion`: as compositor::MeasureCameraLook().
  std::optional<compositor::CameraLook> Update(ImageView<const std::uint8_t> rgb,
                                               const CameraModel& camera,
                                               const Transform<Camera, Marker>& camera_from_marker,
                                               const scene::MarkerReflectance& marker,
                                               const CameraResponse& response,
                                               const std::optional<compositor::ThinLens>& lens,
                                               const compositor::CameraMotion& motion);

 private:
  int frames_to_next_ = 0;  // Until the next measurement.
  std::deque<compositor::CameraLook> recent_;
};

}  // namespace pleinair::session
