#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/vector.h"
#include "compositor/photometry/exposure_filter.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "session/light_summary.h"

namespace pleinair::session {

/// The camera's exposure scale (display-linear value per cd/m² and channel), read from the marker
/// in frame after frame.
class ExposureMeter {
 public:
  /// How the marker is lit from the next frame on; nothing: it cannot be read.
  void SetMeter(std::optional<compositor::MarkerLightMeter> meter) { meter_ = std::move(meter); }

  /// What the exposure scale is taken for as long as no frame could be read.
  void SetGuess(LinearRgb exposure_scale) { guess_ = exposure_scale; }

  /// Once a frame could be read its exposure scale is kept while this holds.
  void SetLocked(bool locked) { locked_ = locked; }

  /// Reads a frame and writes what is known to `summary`. `marker_shade`: SkyState::marker_shade.
  void Read(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
            const Transform<Camera, Marker>& camera_from_marker, LinearRgb marker_shade,
            LightSummary* summary);

 private:
  std::optional<compositor::MarkerLightMeter> meter_;
  compositor::ExposureFilter filter_;
  LinearRgb guess_;
  bool locked_ = false;
};

}  // namespace pleinair::session
