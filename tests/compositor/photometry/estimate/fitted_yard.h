#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "base/image.h"
#include "base/srgb.h"
#include "base/vector.h"
#include "compositor/photometry/estimate/light_cells.h"
#include "compositor/photometry/estimate/light_posterior.h"
#include "compositor/photometry/estimate/sunlight_map.h"
#include "compositor/photometry/surface_samples.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::compositor::testing {

/// A yard with known light, and what the fit makes of photographs of it.
class FittedYard : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { yard_ = new PhotographedYard(); }
  static void TearDownTestSuite() {
    delete yard_;
    yard_ = nullptr;
  }

  static SurfaceSamples Look(const PhotographedYard::Light& light, int pictures = 2,
                             double exposure_step = 1.0) {
    SurfaceSamples samples(yard_->phantoms(), yard_->camera(), yard_->marker());
    for (int i = 0; i < pictures; ++i) {
      const double exposure_scale = i == 0 ? 1.0 : exposure_step;
      RgbImage picture = yard_->Photograph(i, light);
      if (exposure_scale != 1.0) {
        for (std::size_t k = 0; k < picture.size(); ++k) {
          picture.data()[k] =
              Srgb8FromLinear(LinearFromSrgb8()[picture.data()[k]] * exposure_scale);
        }
      }
      samples.AddFrame(picture.view(), PhotographedYard::Pose(i),
                       {exposure_scale, exposure_scale, exposure_scale});
    }
    return samples;
  }
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
                                         .prior = {0.5, 0.45, 0.05, 1.2}});
    return found;
  }
  static Found Fit(const SurfaceSamples& samples) {
    return Fit(samples, yard_->phantoms(), yard_->model());
  }

  static inline PhotographedYard* yard_ = nullptr;
};

}  // namespace pleinair::compositor::testing
