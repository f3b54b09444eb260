#include "sky/clouds/photon_paths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/clouds/cloud_slab.h"
#include "sky/clouds/tilted_columns.h"

namespace pleinair::clouds {
namespace {

constexpr int kPhotons = 40'000;
constexpr double kBound = 0.01;  // Four standard deviations.
constexpr Vec3 kZenith{0.0, 0.0, 1.0}, kSlanted{0.8660254, 0.0, 0.5};

CloudVolume Slab(double depth) {
  CloudVolume slab;
  slab.extinction = [depth](Vec3) { return depth; };
  // Twice the extinction: most of the steps meet nothing.
  slab.most_extinction = 2.0 * depth;
  slab.top_m = 1.0;
  return slab;
}

TEST(PhotonPaths, HaveTheFluxOfASlab) {
  for (const double depth : {1.0, 8.0}) {
    for (const Vec3 sun : {kZenith, kSlanted}) {
      const PhotonFluxes found = TracePhotons(Slab(depth), sun, kPhotons, 3);
      EXPECT_NEAR(found.reflected, SlabTable::Water().Reflected(depth, sun.z), kBound);
      EXPECT_NEAR(found.direct, std::exp(-depth / sun.z), kBound);
      EXPECT_NEAR(found.reflected + found.transmitted, 1.0, 1e-9);
    }
  }
}

// 1e5 photons, ±0.002: docs/method/clouds.md.
TEST(PhotonPaths, HaveTheFluxOfTheStepCloud) {
  CloudVolume step = StepCloud::Volume();
  EXPECT_NEAR(TracePhotons(step, kZenith, kPhotons, 1).reflected, 0.326, kBound);
  EXPECT_NEAR(TracePhotons(step, kZenith, kPhotons, 1).direct, 0.067, kBound);
  EXPECT_NEAR(TracePhotons(step, kSlanted, kPhotons, 2).reflected, 0.579, kBound);
  step.single_scattering_albedo = 0.99;
  const PhotonFluxes absorbed = TracePhotons(step, kZenith, kPhotons, 5);
  EXPECT_NEAR(absorbed.reflected, 0.261, kBound);
  EXPECT_NEAR(absorbed.absorbed, 0.141, kBound);
}

TEST(PhotonPaths, DependOnTheSeedAlone) {
  const PhotonFluxes a = TracePhotons(Slab(4.0), kSlanted, 2'000, 8);
  EXPECT_EQ(a.reflected, TracePhotons(Slab(4.0), kSlanted, 2'000, 8).reflected);
  EXPECT_NE(a.reflected, TracePhotons(Slab(4.0), kSlanted, 2'000, 9).reflected);
  EXPECT_EQ(TracePhotons({}, kZenith, 10, 1).direct, 1.0);
}

TEST(TiltedColumns, AreNearThePathsThroughTheStepCloud) {
  const auto place = [](int i) { return 0.5 * i + 0.25; };
  const auto reflected = [&](Vec3 sun) {
    return SharesOfTiltedColumns(
               SlabTable::Water(), sun.z, 1000,
               [&](int i) { return StepCloud::DepthAlong(place(i), sun); },
               [&](int i) { return StepCloud::Depth(place(i)); })
        .reflected;
  };
  EXPECT_NEAR(reflected(kZenith) / 0.326, 1.0, 0.05);
  EXPECT_NEAR(reflected(kSlanted) / 0.579, 1.0, 0.12);
}

TEST(StepCloud, HasTheDepthOfItsRays) {
  EXPECT_EQ(StepCloud::DepthAlong(100.0, kZenith), 2.0);
  EXPECT_EQ(StepCloud::DepthAlong(300.0, kZenith), 18.0);
  // A whole period: the mean.
  const double travel = StepCloud::kPeriod_m, height = StepCloud::kThickness_m;
  const double length = std::hypot(travel, height);
  EXPECT_NEAR(StepCloud::DepthAlong(77.0, {travel / length, 0.0, height / length}),
              10.0 * length / height, 1e-9);
}

}  // namespace
}  // namespace pleinair::clouds
