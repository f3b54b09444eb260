#pragma once

#include <vector>

#include "base/vector.h"
#include "compositor/photometry/estimate/light_cells.h"
#include "compositor/photometry/estimate/light_posterior.h"
#include "compositor/photometry/estimate/sunlight_map.h"
#include "compositor/photometry/surface_samples.h"
#include "tests/compositor/photometry/shadow_light_yard.h"

namespace pleinair::compositor::testing {

/// A yard with known light, and what the fit makes of photographs of it.
class FittedYard : public ShadowLight {
 protected:
  /// What the fit makes of samples whose exposure scale no marker binds.
  struct Found {
    std::vector<LightCell> cells;
    LightPosterior light;
    Vec3 to_sun;
    SunTransmittanceMap Map(const SurfaceSamples& samples, const PhantomRays& phantoms) const {
      return MapSunlight(phantoms, samples, cells, light, to_sun);
    }
  };
  static Found Fit(const SurfaceSamples& samples, const PhantomRays& phantoms,
                   const sky::SkyModel& day, const MarkerLight& marker = {}) {
    const UniformDay clouds({8e3, 8e3, 8e3}, {}, day.ToSun().xyz);
    Found found;
    found.to_sun = Normalized(day.ToSun().xyz);
    found.cells = FindLightCells(phantoms, samples, day, clouds, Mat3{});
    found.light = FitLight(found.cells, {.marker = marker,
                                         .sun = day.SunNormalIrradiance(),
                                         .up = {0, 0, 1},
                                         .to_sun = found.to_sun,
                                         .prior = {0.5, 0.45, 0.05, 1.2}});
    return found;
  }
  static Found Fit(const SurfaceSamples& samples) {
    return Fit(samples, yard_->phantoms(), yard_->model());
  }
};

}  // namespace pleinair::compositor::testing
