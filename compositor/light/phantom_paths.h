#pragma once

#include <cstdint>

#include "base/vector.h"
#include "compositor/light/sampling.h"
#include "compositor/light/sky_table.h"
#include "compositor/light/sun_transmittance_map.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

struct PatchScene;

/// Traces paths among a scene's phantoms in the light of one day. Every hit reflects diffusely and
/// samples the sun; a path that leaves the scene samples the sky (Kajiya 1986).
class PhantomPaths {
 public:
  /// Tabulates the sky. `bounces`: max. number of reflections. Surfaces reflect the sunlight that
  /// `sun_transmittance` transmits. `scene` and `sun_transmittance` must outlive this object.
  PhantomPaths(const PatchScene& scene, int bounces, const sky::SkyModel& day,
               const Mat3& marker_from_world, const SunTransmittanceMap& sun_transmittance);

  /// Irradiance without direct sunlight at a point of a surface with tangent frame `frame`: lux,
  /// linear Rec.709. The result is bit-identical for equal `paths`.
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
