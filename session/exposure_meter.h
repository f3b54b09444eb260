#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "base/camera_image.h"
#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/photometry/exposure_filter.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "session/light_follower.h"
#include "session/light_summary.h"

namespace pleinair::session {

/// Estimates the camera's exposure scale (display-linear value per cd/m² and channel) from the
/// marker in each frame.
class ExposureMeter {
 public:
  /// Sets the meter with the marker's light for the next frames; nothing: the marker cannot be
  /// measured.
  void SetMeter(std::optional<compositor::MarkerLightMeter> meter) { meter_ = std::move(meter); }

  /// Sets the exposure scale that is used until a frame gives an estimate.
  void SetGuess(LinearRgb exposure_scale) { guess_ = exposure_scale; }

  /// While locked, the exposure scale stays that of the last frame, but for the light that is
  /// followed. If none was read before, it stays the same once a frame has given an estimate.
  void SetLocked(bool locked) {
    if (locked && !locked_) holds_ = is_used_;
    locked_ = locked;
  }

  /// Measures a frame and writes the result to `summary`. `marker_shade`: SkyState::marker_shade.
  /// `camera_from_marker`: nothing where the frame
  /// does not show the marker. `followed`: how the frame's light differs from the meter's.
  void Read(CameraImageView image, const CameraModel& camera,
            const std::optional<Transform<Camera, Marker>>& camera_from_marker,
            LinearRgb marker_shade, const FollowedLight& followed, LightSummary* summary);

 private:
  std::optional<compositor::MarkerLightMeter> meter_;
  compositor::ExposureFilter filter_;
  LinearRgb guess_, last_;               // Last: of the reference light.
  bool locked_ = false, holds_ = false;  // Holds: what the last frame before the lock had.
  bool is_used_ = false;                 // A frame was read.
};

}  // namespace pleinair::session
