// Reflectances that are measured from photographs of a yard, against the true ones.

#include "compositor/photometry/surface_colors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/surface_samples.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;
using Outcome = SurfaceColor::Outcome;

enum Model { kPaving, kWall, kPole, kStep };

/// The yard in its own light. Paving that `brighter` multiplies differs from the described one.
std::map<int, SurfaceColor> ColorsOf(PhotographedYard::Light light) {
  static const PhotographedYard yard;
  light.colors_as_described = true;
  const MarkerLightMeter meter(yard.marker(), yard.phantoms(), yard.model(),
                               yard.marker_from_world());
  SurfaceSamples samples(yard.phantoms(), yard.camera(), yard.marker());
  for (const int i : {0, 1}) {
    // The yard has a plain white marker: its exposure is known.
    const LinearRgb scale =
        LinearRgb{1, 1, 1} * (PhotographedYard::kExposureScale * light.exposure);
    samples.AddFrame(yard.Photograph(i, light).view(), PhotographedYard::Pose(i), scale);
  }
  return MeasureSurfaceColors(yard.phantoms(), samples,
                              {.meter = meter,
                               .day = yard.model(),
                               .skies = SkyState(),
                               .marker_from_world = yard.marker_from_world()},
                              {kPaving, kWall, kStep});
}

void ExpectColor(const SurfaceColor& color, LinearRgb truth, double tolerance) {
  ASSERT_EQ(color.outcome, Outcome::kMeasured);
  EXPECT_NEAR(color.reflectance.r / truth.r, 1.0, tolerance);
  EXPECT_NEAR(color.reflectance.g / truth.g, 1.0, tolerance);
  EXPECT_NEAR(color.reflectance.b / truth.b, 1.0, tolerance);
  EXPECT_GT(color.relative_error, 0.1);
  EXPECT_LT(color.relative_error, 0.3);
}

TEST(SurfaceColors, AreThoseOfTheYard) {
  const auto colors = ColorsOf({});
  ExpectColor(colors.at(kPaving), {0.35, 0.33, 0.30}, 0.05);
  ExpectColor(colors.at(kWall), {0.35, 0.20, 0.15}, 0.08);
  ExpectColor(colors.at(kStep), {0.4, 0.4, 0.38}, 0.08);
  EXPECT_EQ(colors.size(), 3U);
}

TEST(SurfaceColors, AreNotThoseOfUnknownShadeAndThingsInFront) {
  // A tree's shade on a third of the yard, and pale things on a sixth of it.
  const PhotographedYard::Light light{
      .shaded = [](Vec3 p) { return std::sin(7 * p.x) * std::sin(9 * p.y) > 0.5; },
      .brighter = [](Vec3 p) { return std::fmod(p.x + 20.0, 0.6) < 0.1 ? 2.0 : 0.6; }};
  const auto colors = ColorsOf(light);
  ExpectColor(colors.at(kPaving), LinearRgb{0.35, 0.33, 0.30} * 0.6, 0.1);
}

TEST(SurfaceColors, AreNotMeasuredWhereTheFramesDoNotShowThem) {
  EXPECT_EQ(ColorsOf({.exposure = 12.0}).at(kPaving).outcome, Outcome::kClipped);
  const auto chess = [](Vec3 p) {
    return std::exp(std::fmod(std::fabs(17 * p.x + 29 * p.y), 1.6) - 1.0);
  };
  EXPECT_EQ(ColorsOf({.brighter = chess}).at(kPaving).outcome, Outcome::kUneven);
}

}  // namespace
}  // namespace pleinair::compositor
