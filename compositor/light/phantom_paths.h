#pragma once

#include <cstdint>

#include "base/vector.h"
#include "compositor/light/sampling.h"
#include "compositor/light/sky_table.h"
#include "compositor/light/sun_transmittance_map.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

struct PatchScene;

/// Traces paths among a scene's phantoms in the light of one day: diffuse reflection at every hit,
/// the sun sampled there, the sky where a path leaves the scene (Kajiya 1986).
class PhantomPaths {
 public:
  /// Tabulates the sky. `bounces`: reflections followed at most. Of the sun, surfaces reflect what
  /// `sun_transmittance` leaves it. `scene` and `sun_transmittance` must live as long.
  PhantomPaths(const PatchScene& scene, int bounces, const sky::SkyModel& day,
               const Mat3& marker_from_world, const SunTransmittanceMap& sun_transmittance);

  /// Irradiance at a point whose surface has `frame`, without the sun's direct light: lux, linear
  /// Rec.709. Equal `paths` give equal bits.
  LinearRgb Irradiance(Vec3 point, const TangentFrame& frame, std::uint32_t paths) const;

 private:
  const PatchScene& scene_;
  int bounces_;
  SkyTable sky_;
  TangentFrame sun_frame_;
  LinearRgb sun_;
  const SunTransmittanceMap& sun_transmittance_;
};

}  // namespace pleinair::compositor
