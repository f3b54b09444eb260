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
  /// kTooFew: fewer than 40 usable samples. kClipped: over half of the samples are too bright or
  /// too dark for the camera. kUneven: no brightness prevails. kImpossible: no surface has this
  /// color (luminance below 0.01, a channel above 0.95). kNoLight: the marker gave no exposure, or
  /// the sun is doubtful.
  enum class Outcome { kMeasured, kTooFew, kClipped, kUneven, kImpossible, kNoLight };
  Outcome outcome = Outcome::kTooFew;
  LinearRgb reflectance{};      ///< Linear Rec.709; only if measured.
  double relative_error = 0.0;  ///< One standard deviation; only if measured.
  int places = 0;               ///< Surface samples that agree.
};

/// The estimated light on the surfaces, for their reflectance.
struct LightOnSurfaces {
  const MarkerLightMeter& meter;  ///< Gave the samples their exposure scale.
  const sky::SkyModel& day;       ///< Estimated sun and sky; may have no sun.
  const SkyState& skies;          ///< Unmodelled shadows that go with `day`.
  const Mat3& marker_from_world;  ///< With the heading in use.
  bool is_known = true;           ///< False: no exposure, or a doubtful sun.
};

/// Estimates the reflectance of placed models, each of one color. `placed_models` are indices into
/// the scene's list; the result has one entry for each. Surfaces are Lambertian. Sample i of
/// brightness I_i has the reflectance of Eq. (5a) in docs/method/photometry.md:
///
///     ρ_i = π I_i / ( V_i T_i E_sun cos θ_i + A_i ) · E_marker / ( E_meter m )
///
/// where V is the sun visibility, T the sun transmittance map, A the light from the sky and from
/// reflections (192 paths). E_marker is the light on the marker by `day`, E_meter that of the
/// meter, and m the marker's shading (SkyState::marker_shade). Irradiances are in lux.
///
/// The result is the mean of the samples about the middle of their shortest half (Rousseeuw & Leroy
/// 1987, "Robust Regression and Outlier Detection"). Up to half of the samples may contradict it:
/// objects in front, unmodelled shadows, stains.
std::map<int, SurfaceColor> MeasureSurfaceColors(const PhantomRays& phantoms,
                                                 const SurfaceSamples& samples,
                                                 const LightOnSurfaces& light,
                                                 const std::set<int>& placed_models);

}  // namespace pleinair::compositor
