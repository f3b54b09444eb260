#pragma once

#include <optional>

#include "base/vector.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/picture/camera_look.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// Light at which the report states noise, of the brightest: a sunlit grey.
inline constexpr double kMediumLight = 0.2;

/// What is known of a frame's light: sun, sky, and what the camera makes of them.
struct LightSummary {
  sky::SunPosition sun;
  double sun_normal_lux = 0.0;
  double sky_horizontal_lux = 0.0;
  /// Who says what the camera's exposure scale is; kGuess: no frame could be read and the scene
  /// gives none.
  enum class ExposureScaleSource { kMarker, kScene, kGuess };
  ExposureScaleSource exposure_scale_source = ExposureScaleSource::kMarker;
  LinearRgb exposure_scale;  ///< Display-linear value per cd/m².
  /// See ExposureFilter::Error(); of kMarker.
  LinearRgb exposure_scale_error;
  /// See ExposureFilter::Change().
  double exposure_scale_change = 1.0;
  int exposure_estimates = 0;  ///< Frames in which the marker served as a light meter.
  int dappled_estimates = 0;   ///< Of these, the ones in which leaves shade it.
  /// Share of the print that the phantoms leave in the sun, of the last estimate.
  double marker_sunlit_share = 0.0;
  /// Blur and grain of the last frames; nothing where they are not matched or cannot be read.
  std::optional<compositor::CameraLook> look;
  compositor::MeasuredLight measured;  ///< Sun, sky and heading.
};

/// Share of the readings in which leaves shade the print; 0 without any.
inline double DappledShare(const LightSummary& light) {
  return light.exposure_estimates > 0
             ? static_cast<double>(light.dappled_estimates) / light.exposure_estimates
             : 0.0;
}

}  // namespace pleinair::session
