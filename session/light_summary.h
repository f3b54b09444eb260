#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/surface_colors.h"
#include "compositor/picture/camera_look.h"
#include "session/frame_lens.h"
#include "session/light_follower.h"
#include "session/motion/frame_exposure.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// Linear light at which the report gives the noise, relative to the brightest: a sunlit grey.
inline constexpr double kMediumLight = 0.2;

/// Light of a single frame.
struct FrameLightSummary {
  /// Display-linear value that a white, level, Lambertian surface in the open has of the sun and of
  /// the sky.
  LinearRgb sun_on_white, sky_on_white;
  FollowedLight followed;  ///< How this frame's light differs from that of the recording.
};

/// Exposure of the frames so far.
struct ExposureHistory {
  int estimates = 0;    ///< Frames in which the marker gave an exposure estimate.
  int dappled = 0;      ///< Those in which leaves shade the marker.
  double change = 1.0;  ///< See ExposureFilter::Change().
  /// Share of the marker that the phantoms leave sunlit, at the last estimate.
  double sunlit_share = 0.0;
};

/// What the frames show of the camera's response (compositor/photometry/response/response_fit.h).
struct ResponseSummary {
  /// kSrgb and kFilm (the film's tags): the frames do not contradict it strongly.
  enum class Source { kSrgb, kFilm, kMeasured, kStated };
  Source source = Source::kSrgb;
  /// Logarithm of the evidence for another curve over that for sRGB; 0 where nothing shows it.
  double log_evidence = 0.0;
  /// Standard deviation of the logarithm of light relative to that of the marker's white; 0 where
  /// nothing shows it.
  double log_error = 0.0;

  bool IsShown() const { return log_error > 0.0; }
};

/// Color of a surface that the scene describes without one.
struct SurfaceColorSummary {
  std::string surface;    ///< "ground", "box 1", "wall 2".
  LinearRgb reflectance;  ///< In use: measured, or the usual one.
  compositor::SurfaceColor measured;
};

/// How drawn pixels were made to look like the camera's.
struct CameraSummary {
  /// Blur and noise of the last frames; with a lens, the blur is that in focus. Empty where they
  /// are not matched or cannot be measured.
  std::optional<compositor::CameraLook> look;
  LensFactSource defocus = LensFactSource::kOff;
  std::optional<compositor::ThinLens> lens;  ///< At the last frame.
  int lens_places = 0;                       ///< DefocusOptions::places.
  FrameExposure::Exposure exposure;          ///< The last frame's, by which motion blurs.
  compositor::LensFigures drawn_lens;        ///< The largest of all frames so far.
  double mixed_pixels = 0.0;                 ///< Composer::MixedPixels().
};

/// Light of a frame: sun, sky and exposure.
struct LightSummary {
  sky::SunPosition sun;
  double sun_normal_lux = 0.0;
  double sky_horizontal_lux = 0.0;
  /// Source of the exposure scale. kGuess: no frame gave an estimate and the scene has none.
  enum class ExposureScaleSource { kMarker, kScene, kGuess };
  ExposureScaleSource exposure_scale_source = ExposureScaleSource::kMarker;
  LinearRgb exposure_scale;  ///< Display-linear value per cd/m².
  FrameLightSummary frame;
  /// ExposureFilter::Error() with the errors that all frames share; only for kMarker.
  LinearRgb exposure_scale_error;
  ExposureHistory exposures;
  CameraSummary camera;
  compositor::MeasuredLight measured;  ///< Sun, sky and heading.
  ResponseSummary response;
  std::vector<SurfaceColorSummary> surface_colors;
};

/// Share of the exposure estimates in which leaves shade the marker; 0 without any.
inline double DappledShare(const LightSummary& light) {
  return light.exposures.estimates > 0
             ? static_cast<double>(light.exposures.dappled) / light.exposures.estimates
             : 0.0;
}

}  // namespace pleinair::session
