#pragma once

#include <gtest/gtest.h>

#include "base/image.h"
#include "base/srgb.h"
#include "base/vector.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "compositor/photometry/surface_samples.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::compositor::testing {

/// A yard with known light, and surface samples from photographs of it.
class ShadowLight : public ::testing::Test {
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
  static SunSkyRatio Read(const SurfaceSamples& samples) {
    return EstimateSunSkyRatio(FindShadowEdges(yard_->phantoms(), samples, yard_->model(), Mat3{}));
  }

  static inline PhotographedYard* yard_ = nullptr;
};

}  // namespace pleinair::compositor::testing
