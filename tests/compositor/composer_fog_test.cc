// Tests haze and fog between the camera and the drawn surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/srgb.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/scene_view.h"
#include "shadows/splits.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

TEST(Composer, SeesTheObjectThroughAsMuchFogAsItIsToldTo) {
  const SouthernSun clear;
  const HazySouthernSun needs_airlight(3.0);
  const std::vector<PlacedModel> scene{kGround, kCube};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
  ASSERT_TRUE(solver.has_value());
  const auto lit = (*solver)->Solve(clear, Mat3{});
  auto composer = Composer::Create(kCamera, scene, {});
  ASSERT_TRUE(composer.has_value());
  const auto top = [&](const sky::SkyModel& day, double fog) {
    ComposerOptions options;
    options.fog.fill(fog);
    EXPECT_TRUE((*composer)->SetOptions(options));
    EXPECT_TRUE((*composer)->SetLight(lit, day, Mat3{}, (*solver)->RadianceFromBelow(day, Mat3{})));
    const auto composed = (*composer)->Compose(EvenPicture(128).view(), kFromAbove,
                                               {kExposureScale, kExposureScale, kExposureScale});
    return SeenAt(*composed, {0, 0, 0.3});
  };
  const double plain = top(clear, 1.0);
  EXPECT_EQ(top(needs_airlight, 0.0), plain);
  for (const double fog : {1.0, 2.0}) {
    const double left = std::exp2(-fog * 2.7 / 3.0);
    EXPECT_NEAR(top(needs_airlight, fog),
                plain * left + kExposureScale * HazySouthernSun::kAirlight * (1.0 - left), 0.02)
        << fog;
  }
}

TEST(Composer, DrawsFogOfDifferentPartitionsWithoutASeam) {
  // A virtual lawn from below the camera to the horizon, with fog by the formula.
  const std::vector<PlacedModel> scene{Place(MakeBox({-400, -400, 0}, {400, 400, 0}, 0.5F), false)};
  const Transform<Camera, Marker> eye_level{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {0, 2, 0}};
  const HazySouthernSun day(3.0);
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 16, .near_edge_m = 100.0});
  ASSERT_TRUE(solver.has_value());
  ComposerOptions options;
  options.shadow_partitions = 4;
  options.fog = {0.0, 0.06, 0.005, 0.02};
  auto composer = Composer::Create(kCamera, scene, options);
  ASSERT_TRUE(composer.has_value());
  ASSERT_TRUE((*composer)->SetLight((*solver)->Solve(day, Mat3{}), day, Mat3{},
                                    (*solver)->RadianceFromBelow(day, Mat3{})));
  const auto composed = (*composer)->Compose(EvenPicture(0).view(), eye_level,
                                             {kExposureScale, kExposureScale, kExposureScale});
  ASSERT_TRUE(composed.has_value());
  const shadows::View view =
      ViewOf(FitRenderCamera(kCamera, 1.0), eye_level, {{-400, -400, 0}, {400, 400, 0}});
  const std::vector<double> splits =
      shadows::PracticalSplits(view.near_m, view.far_m, 4, options.shadow_split_weight);
  const double radiance =
      0.5 * (kSkyLux + kSunLux * std::numbers::sqrt2 / 2) * std::numbers::inv_pi;
  int partitions_seen = 0;
  double last = -1.0;
  for (int y = kCamera.height - 1; y > 122; --y) {
    const double down = (y - kCamera.cy) / kCamera.fy;
    const double distance = 2.0 * std::sqrt(1.0 + down * down) / down;  // To a point ahead.
    double through_m = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double length = std::clamp(distance - (i == 0 ? 0.0 : splits[i]), 0.0,
                                       splits[i + 1] - (i == 0 ? 0.0 : splits[i]));
      through_m += options.fog[i] * length;
      if (length > 0.0) partitions_seen = std::max(partitions_seen, i + 1);
    }
    const double left = std::exp2(-through_m / 3.0);
    const double seen = LinearFromSrgb8()[(*composed)(160, y, 1)];
    EXPECT_NEAR(
        seen, kExposureScale * (radiance * left + HazySouthernSun::kAirlight * (1.0 - left)), 0.02)
        << "row " << y << ", " << distance << " m";
    // Fog may thicken from row to row. A seam would be a step.
    if (last >= 0.0 && distance < 60.0) {
      EXPECT_NEAR(seen, last, 0.02) << "row " << y;
    }
    last = seen;
  }
  EXPECT_GE(partitions_seen, 3);
}

/// The same light in air that transmits 60 % over 200 m.
class HazySouthernField : public SouthernSun {
 public:
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const double left = std::pow(kLeft, distance.value() / 200.0);
    return {{left, left, left}, LinearRgb{1.0, 1.0, 1.0} * (kAirlight * (1.0 - left))};
  }
  static constexpr double kLeft = 0.6, kAirlight = 6000.0;
  /// Linear value of a surface 200 m away.
  static double Shown(double radiance) {
    return kExposureScale * (radiance * kLeft + kAirlight * (1.0 - kLeft));
  }
};

TEST(Composer, FadesAShadowOnARealSurface200MetresAwayAsHazeFadesARealOne) {
  const PlacedModel field = Place(MakeBox({-150, -150, 0}, {150, 150, 0}, 0.3F), true);
  const PlacedModel tower = Place(MakeBox({-10, -10, 0.01}, {10, 10, 20}, 0.5F), false);
  const Transform<Camera, Marker> from_far_above{kFromAbove.rotation, {0, 0, 200}};
  const std::vector<PlacedModel> scene{field, tower};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64, .near_edge_m = 2.0});
  ASSERT_TRUE(solver.has_value());
  const HazySouthernField day;
  const auto lit = (*solver)->Solve(day, Mat3{});
  auto composer = Composer::Create(kCamera, scene, {});
  ASSERT_TRUE(composer.has_value());
  ASSERT_TRUE((*composer)->SetLight(lit, day, Mat3{}, (*solver)->RadianceFromBelow(day, Mat3{})));
  const auto shadow = [&](double picture, double fog) {
    ComposerOptions options;
    options.fog.fill(fog);
    EXPECT_TRUE((*composer)->SetOptions(options));
    const auto code = static_cast<std::uint8_t>(std::lround(255.0 * SrgbFromLinear(picture)));
    const auto composed = (*composer)->Compose(EvenPicture(code).view(), from_far_above,
                                               {kExposureScale, kExposureScale, kExposureScale});
    const Vec2 pixel = ProjectToPixel(kCamera, from_far_above * Point<Marker>{{0, 20, 0}});
    return LinearFromSrgb8()[(*composed)(static_cast<int>(std::lround(pixel.x)),
                                         static_cast<int>(std::lround(pixel.y)), 1)];
  };
  const double sunlit = 0.3 * (kSkyLux + kSunLux * std::numbers::sqrt2 / 2) / std::numbers::pi;
  // A near view gives the share of the light that the tower leaves.
  const double ratio = shadow(kExposureScale * sunlit, 0.0) / (kExposureScale * sunlit);
  EXPECT_NEAR(ratio, 0.23, 0.06);
  EXPECT_NEAR(shadow(HazySouthernField::Shown(sunlit), 1.0),
              HazySouthernField::Shown(ratio * sunlit), 0.006);
  EXPECT_LT(shadow(HazySouthernField::Shown(sunlit), 0.0),
            HazySouthernField::Shown(ratio * sunlit) - 0.04);
  // Half the air has half the optical depth.
  const double left = std::sqrt(HazySouthernField::kLeft);
  const double air = kExposureScale * HazySouthernField::kAirlight * (1.0 - left);
  EXPECT_NEAR(shadow(kExposureScale * sunlit * left + air, 0.5),
              kExposureScale * ratio * sunlit * left + air, 0.006);
  // The composer detects existing shadows in the image through the haze.
  const double shaded = HazySouthernField::Shown(0.3 * kSkyLux / std::numbers::pi);
  EXPECT_NEAR(shadow(shaded, 1.0), shaded, 0.015);
  EXPECT_LT(shadow(shaded, 0.0), 0.7 * shaded);
}

}  // namespace
}  // namespace pleinair::compositor
