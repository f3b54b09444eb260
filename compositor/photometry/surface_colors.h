#pragma once

#include <map>
#include <set>

#include "base/vector.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/sky_state.h"
#include "compositor/photometry/surface_samples.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Diffuse reflectance of a surface, estimated from frames.
struct SurfaceColor {
  /// kTooFew: too few places of it are seen. kClipped: most of them are too bright or too dark for
  /// the camera. kUneven: no brightness prevails. kImpossible: no surface has this color, so that
  /// the light is wrong. kNoLight: the marker gave no exposure, or the sun is doubtful.
  enum class Outcome { kMeasured, kTooFew, kClipped, kUneven, kImpossible, kNoLight };
  Outcome outcome = Outcome::kTooFew;
  LinearRgb reflectance{};      ///< Linear Rec.709; only if measured.
  double relative_error = 0.0;  ///< One standard deviation; only if measured.
  int places = 0;               ///< Surface samples that agree.
};

/// The light in which surfaces are seen.
struct LightOnSurfaces {
  const MarkerLightMeter& meter;  ///< That of the samples' exposure scale.
  const sky::SkyModel& day;       ///< Scaled; may have no sun.
  const SkyState& skies;          ///< Unmodelled shadows that go with `day`.
  const Mat3& marker_from_world;  ///< With the heading in use.
  bool is_known = true;           ///< False: no exposure, or a doubtful sun.
};

/// Estimates the reflectance of placed models, each of one color. `placed_models` are indices into
/// the scene's list. Sample i of brightness I_i has the reflectance
///
///     ρ_i = π I_i / ( V_i T_i E_sun cos θ_i + A_i ) · E_marker / E_meter
///
/// with the sun visibility V, the transmittance T of unmodelled geometry, sky and reflected light A
/// (192 paths), and the light on the marker by this day and by the meter. The result is the mean of
/// the samples about the middle of their shortest half (Rousseeuw & Leroy 1987), which half of them
/// may contradict: things in front, shade of unknown things, stains.
std::map<int, SurfaceColor> MeasureSurfaceColors(const PhantomRays& phantoms,
                                                 const SurfaceSamples& samples,
                                                 const LightOnSurfaces& light,
                                                 const std::set<int>& placed_models);

}  // namespace pleinair::compositor
