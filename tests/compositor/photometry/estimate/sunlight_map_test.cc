// Tests the map of unmodelled shade on images with known light.
#include "compositor/photometry/estimate/sunlight_map.h"

#include <gtest/gtest.h>

#include "tests/compositor/photometry/estimate/fitted_yard.h"
#include "tests/compositor/photometry/shade_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::FittedYard;

TEST_F(FittedYard, MapsWhereTheSunComesThroughTrees) {
  const SurfaceSamples samples = Look(testing::StripedShade(*yard_));
  testing::ExpectStripes(*yard_, Fit(samples).Map(samples, yard_->phantoms()));
}

TEST_F(FittedYard, MapsNoShadeWherePavingHasDarkJoints) {
  const SurfaceSamples samples = Look(testing::ShadeBesideJoints());
  testing::ExpectOpenJoints(*yard_, Fit(samples).Map(samples, yard_->phantoms()));
}

}  // namespace
}  // namespace pleinair::compositor
