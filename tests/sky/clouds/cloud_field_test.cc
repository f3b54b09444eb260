#include "sky/clouds/cloud_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "sky/clouds/cloud_shadow.h"
#include "sky/clouds/cloud_slab.h"
#include "sky/sun/solar_disc.h"

namespace pleinair::clouds {
namespace {

CloudLayer Layer(const std::string& text) { return ParseCloudLayer(text).value(); }

Direction<World> Sun(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

TEST(CloudField, HasTheCoverAndDepthOfItsDescription) {
  for (const char* kind : {"cumulus", "stratocumulus", "altocumulus", "cirrus"}) {
    for (const char* cover : {"0.1", "0.6", "1"}) {
      const CloudLayer layer =
          Layer("kind=" + std::string(kind) + ",cover=" + cover + ",wind_m_s=9,wind_from_deg=70");
      const auto field = CloudField::Of(layer);
      for (const double seconds : {0.0, 777.0}) {
        const CloudStatistics found = field->Statistics(seconds);
        EXPECT_NEAR(found.cover, layer.cover, 0.01) << kind << cover;
        EXPECT_NEAR(found.mean_optical_depth / layer.optical_depth, 1.0, 0.02) << kind << cover;
      }
    }
  }
}

TEST(CloudField, TakesExtremeDescriptions) {
  for (const char* text :
       {"kind=stratus", "kind=cumulus,seed=-9223372036854775808", "kind=cumulus,cell_m=50",
        "kind=cumulus,cell_m=50000", "kind=cumulus,optical_depth=200,cover=0.02",
        "kind=cirrus,optical_depth=0.01", "kind=cirrus,wind_from_deg=135,cell_m=50000"}) {
    const CloudLayer layer = Layer(text);
    const CloudStatistics found = CloudField::Of(layer)->Statistics(0.0);
    EXPECT_NEAR(found.cover, layer.cover, 0.03) << text;
    EXPECT_NEAR(found.mean_optical_depth / layer.optical_depth, 1.0, 0.05) << text;
  }
}

TEST(CloudField, WithoutCoverOrDepthIsClear) {
  for (const char* text :
       {"kind=cumulus,cover=0", "kind=cumulus,optical_depth=0", "kind=slab,optical_depth=0"}) {
    const auto field = CloudField::Of(Layer(text));
    EXPECT_EQ(field->Statistics(0.0).cover, 0.0);
    EXPECT_EQ(SunTransmittance({field}, {}, Sun(180, 40), 0.0), 1.0);
  }
}

TEST(CloudField, MovesWithTheWindAndKeepsItsShape) {
  // From 250°: towards the east-north-east.
  const auto field = CloudField::Of(Layer("kind=cumulus,wind_m_s=8,wind_from_deg=250"));
  const double seconds = 100.0;
  const double east = 800.0 * std::sin(70.0 * kRadiansPerDegree);
  const double north = 800.0 * std::cos(70.0 * kRadiansPerDegree);
  double deepest = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double x = 37.0 * i - 6000.0, y = 53.0 * i - 9000.0;
    const double before = field->ColumnDepth(x, y, 0.0);
    EXPECT_NEAR(field->ColumnDepth(x + east, y + north, seconds), before, 2e-3 * (1.0 + before));
    deepest = std::max(deepest, before);
  }
  EXPECT_GT(deepest, 10.0);
}

TEST(CloudField, DiffersWithItsSeed) {
  const auto one = CloudField::Of(Layer("kind=cumulus,seed=1"));
  const auto two = CloudField::Of(Layer("kind=cumulus,seed=-1"));
  int different = 0;
  for (int i = 0; i < 100; ++i) {
    different += one->ColumnDepth(97.0 * i, 0.0, 0.0) != two->ColumnDepth(97.0 * i, 0.0, 0.0);
  }
  EXPECT_GT(different, 50);
}

TEST(CloudField, HasTheExtinctionThatItsDepthsIntegrate) {
  const auto field = CloudField::Of(Layer("kind=cumulus,cover=0.8"));
  for (int i = 0; i < 20; ++i) {
    const Vec3 below{311.0 * i, 127.0 * i, 0.0};
    double sum = 0.0;
    for (int step = 0; step < 2000; ++step) {
      sum += 0.25 * field->Extinction({below.x, below.y, 1200.0 + 0.25 * (step + 0.5)}, 0.0);
    }
    const double depth = field->DepthAlong(below, {0.0, 0.0, 1.0}, 0.0);
    EXPECT_NEAR(depth, field->ColumnDepth(below.x, below.y, 0.0), 1e-5 * (1.0 + depth));
    EXPECT_NEAR(sum, depth, 0.01 * (0.1 + depth));
  }
}

TEST(CloudShadow, FollowsBeerAndLambertUnderASlab) {
  for (const double depth : {0.1, 1.0, 8.0}) {
    CloudLayer slab = Layer("kind=slab");
    slab.optical_depth = depth;
    for (const double elevation : {6.0, 20.0, 45.0, 90.0}) {
      const double expected = std::exp(-depth / std::sin(elevation * kRadiansPerDegree));
      EXPECT_NEAR(
          SunTransmittance({CloudField::Of(slab)}, {5.0, 7.0, 2.0}, Sun(123, elevation), 9.0),
          expected, 1e-3 * expected);
    }
  }
  EXPECT_EQ(SunTransmittance({CloudField::Of(Layer("kind=slab"))}, {}, Sun(90, -1), 0.0), 0.0);
}

// The shadow lies h/tan(elevation) from below the cloud, away from the sun.
TEST(CloudShadow, IsDisplacedByTheSunsElevation) {
  const auto field =
      CloudField::Of(Layer("kind=cirrus,thickness_m=10,base_m=1000,cell_m=800,optical_depth=5"));
  const double elevation = 25.0;
  const double displacement = 1005.0 / std::tan(elevation * kRadiansPerDegree);
  double best = 1e300, best_shift = 0.0;
  for (int metres = -60; metres <= 60; ++metres) {
    const double shift = displacement + metres;
    double squares = 0.0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 ground{61.0 * i - 9000.0, 17.0 * i, 0.0};
      // The sun stands in the south: its light has passed the layer further south.
      const double column = field->ColumnDepth(ground.x, ground.y - shift, 0.0);
      const double expected = std::exp(-column / std::sin(elevation * kRadiansPerDegree));
      const double difference =
          PointSunTransmittance({field}, ground, Sun(180, elevation), 0.0) - expected;
      squares += difference * difference;
    }
    if (squares < best) {
      best = squares;
      best_shift = shift;
    }
  }
  EXPECT_NEAR(best_shift, displacement, 5.0);
}

// A step in the layer, seen through the disc, has the slope (4/π)/W.
TEST(CloudShadow, ChangesNoFasterThanTheDiscAllows) {
  const auto field = CloudField::Of(Layer("kind=cumulus,base_m=3000,thickness_m=10"));
  const double elevation = 50.0;
  const Direction<World> sun = Sun(180, elevation);
  const double distance = 3005.0 / sun.xyz.z;
  const double width = 2.0 * sky::kSolarRadiusAt1Au * distance;
  const double bound = 4.0 / std::numbers::pi / width;
  constexpr double kStep_m = 5.0;
  double steepest = 0.0, last = 0.0;
  for (int i = 0; i < 1500; ++i) {
    const double now = SunTransmittance({field}, {i * kStep_m, 0.0, 0.0}, sun, 0.0);
    if (i > 0) steepest = std::max(steepest, std::fabs(now - last) / kStep_m);
    last = now;
  }
  EXPECT_LT(steepest, 1.03 * bound);
  EXPECT_GT(steepest, 0.1 * bound);
}

// A cloud passes from 100 s to 200 s, after a gap.
TEST(CloudField, LetsCloudsPassAtKnownTimes) {
  CloudLayer layer = Layer("kind=cumulus,cover=0.5,wind_m_s=10,wind_from_deg=270,seed=4");
  layer.passing = {.east_m = 300.0,
                   .north_m = -200.0,
                   .width_m = 500.0,
                   .seconds = {0.0, 90.0, 110.0, 190.0, 210.0, 300.0},
                   .shifts = {-6.0, -6.0, 6.0, 6.0, -6.0, -6.0}};
  const CloudField field(layer);
  for (int seconds = 0; seconds <= 300; seconds += 5) {
    const double depth = field.ColumnDepth(300.0, -200.0, seconds);
    if (seconds < 80 || seconds > 220) {
      EXPECT_EQ(depth, 0.0) << seconds;
    }
    if (seconds > 120 && seconds < 180) {
      EXPECT_GT(depth, 20.0) << seconds;
    }
  }
  // The strip passes other places at other times, and keeps its shape.
  for (const double along : {-700.0, 900.0}) {
    EXPECT_NEAR(field.ColumnDepth(300.0 + along, -200.0, 150.0 + along / 10.0),
                field.ColumnDepth(300.0, -200.0, 150.0), 1e-3);
  }
  CloudLayer bare = layer;
  bare.passing = {};
  const CloudField without(bare);
  EXPECT_EQ(field.ColumnDepth(300.0, 400.0, 150.0), without.ColumnDepth(300.0, 400.0, 150.0));
  EXPECT_EQ(field.ColumnDepth(4500.0, -200.0, 150.0), without.ColumnDepth(4500.0, -200.0, 150.0));
  EXPECT_NEAR(field.Statistics(0.0).cover, 0.5, 0.01);
  // The quick copy is the same field.
  const CloudField copy(without, {}, layer.passing);
  for (int x = 0; x < 3000; x += 37) {
    EXPECT_EQ(copy.ColumnDepth(x, -200.0, 150.0), field.ColumnDepth(x, -200.0, 150.0));
  }
}

TEST(CloudField, IsDisplaced) {
  const CloudField field(Layer("kind=cumulus,seed=4"));
  const CloudField moved(Layer("kind=cumulus,seed=4,east_m=1000,north_m=-500"));
  for (int x = 0; x < 5000; x += 73) {
    EXPECT_NEAR(moved.ColumnDepth(x + 1000.0, x - 500.0, 0.0), field.ColumnDepth(x, x, 0.0), 1e-2);
  }
}

}  // namespace
}  // namespace pleinair::clouds
