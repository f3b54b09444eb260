// Tests the renderer on small scenes whose light can be calculated by hand.

#include "compositor/composer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "base/srgb.h"
#include "compositor/passes/render_camera.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

TEST(Composer, KeepsTheBytesThatNoVirtualThingTouches) {
  RgbImage noise(kCamera.width, kCamera.height, 3);
  std::mt19937 random(7);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    noise.data()[i] = static_cast<std::uint8_t>(random() & 0xFFU);
  }
  // The cube without real surfaces changes only its own pixels.
  const RgbImage composed = Compose({kCube}, noise);
  int changed = 0;
  for (int y = 0; y < noise.height(); ++y) {
    for (int x = 0; x < noise.width(); ++x) {
      const bool far = std::abs(x - 159.5) > 20 || std::abs(y - 119.5) > 20;
      for (int c = 0; c < 3; ++c) {
        if (far) {
          ASSERT_EQ(composed(x, y, c), noise(x, y, c)) << x << ", " << y;
        } else {
          changed += composed(x, y, c) != noise(x, y, c);
        }
      }
    }
  }
  EXPECT_GT(changed, 2000);
}

TEST(Composer, LightsALevelFaceWithTheWholeSkyAndTheSun) {
  const RgbImage composed = Compose({kGround, kCube}, EvenPicture(128));
  const double lux = kSkyLux + kSunLux * std::numbers::sqrt2 / 2;
  EXPECT_NEAR(SeenAt(composed, {0, 0, 0.3}), kExposureScale * 0.5 * lux / std::numbers::pi, 0.01);
}

TEST(Composer, CastsTheShadowAwayFromTheSunAndLeavesTheSkysShare) {
  const RgbImage picture = EvenPicture(200);
  const double before = LinearFromSrgb8()[200];
  const RgbImage composed = Compose({kGround, kCube}, picture);
  // The sun is in the south: the shadow reaches 0.3 m north of the cube.
  const double share = SeenAt(composed, {0, 0.30, 0}) / before;
  const double sky_share = kSkyLux / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);
  EXPECT_LT(share, sky_share);
  EXPECT_GT(share, 0.5 * sky_share);
  // Just beyond the shadow's end and to the south only slightly less of the sky is visible.
  EXPECT_NEAR(SeenAt(composed, {0, 0.60, 0}) / before, 1.0, 0.04);
  EXPECT_NEAR(SeenAt(composed, {0.6, 0.3, 0}) / before, 1.0, 0.04);
}

TEST(Composer, NeverDarkensARealShadowTwice) {
  // A real wall in the south shades every point that the cube could shade.
  const PlacedModel wall = Place(MakeBox({-3, -0.8, 0}, {3, -0.7, 2.5}, 0.3F), true);
  const RgbImage picture = EvenPicture(120);
  const double before = LinearFromSrgb8()[120];
  const RgbImage composed = Compose({kGround, wall, kCube}, picture);
  // A second shadow from the cube would leave a quarter.
  EXPECT_NEAR(SeenAt(composed, {0, 0.35, 0}) / before, 0.95, 0.1);
  EXPECT_NEAR(SeenAt(composed, {0, 0.8, 0}) / before, 1.0, 0.04);
}

TEST(Composer, DarkensNothingThatATreeShadesAlready) {
  // West of the centre the ground lies in an unmodelled shadow.
  const double lit = 0.3 * 0.8;
  const double shade = lit * kSkyLux / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);
  RgbImage picture = EvenPicture(Srgb8FromLinear(lit));
  for (int y = 0; y < picture.height(); ++y) {
    std::fill_n(picture.view().row(y), 3 * picture.width() / 2, Srgb8FromLinear(shade));
  }
  // Both points lie in the cube's shadow, away from the tree shadow's edge.
  const Vec3 sunlit{0.08, 0.32, 0.0}, shaded{-0.08, 0.32, 0.0};
  const RgbImage composed = Compose({kGround, kCube}, picture);
  EXPECT_LT(SeenAt(composed, sunlit), 1.1 * shade);
  EXPECT_GT(SeenAt(composed, shaded), 0.75 * shade) << "the cube takes some of the sky";
  // Without the test for unmodelled shadows, the tree's shadow is darkened like sunlit ground.
  const RgbImage unasked = Compose({kGround, kCube}, picture, kCamera, kSunLux, {}, {}, false);
  EXPECT_NEAR(SeenAt(unasked, sunlit), SeenAt(composed, sunlit), 0.02);
  EXPECT_LT(SeenAt(unasked, shaded), 0.4 * shade);
}

TEST(Composer, FadesObjectAndShadowUnderTheShadowOfACloud) {
  const auto solver = LightSolver::Create({kGround, kCube}, {.rays_per_vertex = 64});
  const auto composer = Composer::Create(kCamera, {kGround, kCube}, {});
  ASSERT_TRUE(solver);
  ASSERT_TRUE(composer);
  const SouthernSun light;
  ASSERT_TRUE((*composer)->SetLight((*solver)->Solve(light, Mat3{}), light, Mat3{},
                                    (*solver)->RadianceFromBelow(light, Mat3{})));
  (*composer)->AssumeUnmodelledShadows(false);
  struct Seen {
    double top, shadow, open;
  };
  const RgbImage picture = EvenPicture(150);
  const auto seen = [&] {
    const auto composed = (*composer)->Compose(picture.view(), kFromAbove,
                                               {kExposureScale, kExposureScale, kExposureScale});
    EXPECT_TRUE(composed);
    return Seen{SeenAt(*composed, {0, 0.05, 0.3}), SeenAt(*composed, {0, 0.32, 0}),
                SeenAt(*composed, {0.6, 0.3, 0})};
  };
  const Seen sunny = seen();
  // The sun of the frame is a quarter; the clouds leave twice that in the west, none in the east.
  constexpr double kMean = 0.25;
  auto clouds = std::make_shared<SunTransmittanceMap>();
  const double half = std::numbers::sqrt2 / 2;
  clouds->to_sun = light.ToSun().xyz;
  clouds->across_x = {1, 0, 0};
  clouds->across_y = {0, half, half};
  clouds->cell_m = 5.0;
  clouds->width = clouds->height = 1;
  const auto under = [&](float share) {
    auto map = std::make_shared<SunTransmittanceMap>(*clouds);
    map->share = {share};
    EXPECT_TRUE((*composer)->SetSunTransmittance({.clouds = map}));
    return seen();
  };
  ASSERT_TRUE(
      (*composer)->SetLightMix((*solver)->Solve(light, Mat3{}), {.sun = {kMean, kMean, kMean}}));
  const auto expected_top = [&](double sun) {
    return kExposureScale * 0.5 * (kSkyLux + sun * kSunLux * half) / std::numbers::pi;
  };
  const Seen half_sun = under(2.0F), no_sun = under(0.0F);
  EXPECT_NEAR(half_sun.top, expected_top(0.5), 0.01);
  EXPECT_NEAR(no_sun.top, expected_top(0.0), 0.01);
  // The film's ground stays as it is; only the object's shadow on it fades.
  EXPECT_NEAR(half_sun.open, sunny.open, 0.01);
  EXPECT_NEAR(no_sun.open, sunny.open, 0.01);
  const double before = LinearFromSrgb8()[150];
  EXPECT_LT(sunny.shadow, half_sun.shadow);
  EXPECT_NEAR(half_sun.shadow / before, kSkyLux / (kSkyLux + 0.5 * kSunLux * half), 0.08);
  EXPECT_GT(no_sun.shadow / before, 0.75);
}

TEST(Composer, LeavesTheObjectTheSunlightThatComesThroughATree) {
  const SouthernSun light;
  const auto composer = LitComposer({kGround, kCube}, light);
  // On the ground the tree's shadow ends north of the cube. The west half of the cube's shadow
  // overlaps it.
  const Vec3 to_sun = light.ToSun().xyz;
  std::vector<SunlitSample> surface_samples;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j < 110; ++j) {
      const double x = -0.495 + 0.01 * i, y = -0.5 + 0.01 * j;
      surface_samples.push_back({{x, y, 0.0}, x < 0.0 ? 0.0 : 1.0, 0.005});
    }
  }
  const auto seen_on_top = [&] {
    const auto composed = composer->Compose(EvenPicture(150).view(), kFromAbove,
                                            {kExposureScale, kExposureScale, kExposureScale});
    EXPECT_TRUE(composed);
    return std::pair{SeenAt(*composed, {-0.08, 0.05, 0.3}), SeenAt(*composed, {0.08, 0.05, 0.3})};
  };
  const auto open = seen_on_top();
  EXPECT_NEAR(open.first, open.second, 0.01);
  ASSERT_TRUE(
      composer->SetSunTransmittance({.trees = std::make_shared<const SunTransmittanceMap>(
                                         BuildSunTransmittanceMap(to_sun, surface_samples))}));
  const auto [shaded, sunlit] = seen_on_top();
  EXPECT_NEAR(sunlit, open.second, 0.01);
  EXPECT_NEAR(shaded / sunlit, kSkyLux / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2), 0.03);
  ASSERT_TRUE(composer->SetSunTransmittance({}));
  EXPECT_EQ(seen_on_top(), open);
}

TEST(Composer, ShadesTheObjectWhereARealWallKeepsTheSunFromIt) {
  const PlacedModel wall = Place(MakeBox({-3, -0.8, 0}, {3, -0.7, 2.5}, 0.3F), true);
  const double sky_alone = kExposureScale * 0.5 * kSkyLux / std::numbers::pi;
  const double shaded = SeenAt(Compose({kGround, wall, kCube}, EvenPicture(120)), {0, 0, 0.3});
  EXPECT_LT(shaded, 1.05 * sky_alone);
  EXPECT_GT(shaded, 0.5 * sky_alone);  // The wall occludes part of the sky.
}

TEST(Composer, HidesTheObjectBehindAPhantom) {
  const PlacedModel table = Place(MakeBox({-1, -1, 0.8}, {1, 1, 0.85}, 0.3F), true);
  const RgbImage picture = EvenPicture(90);
  const RgbImage composed = Compose({kGround, table, kCube}, picture);
  EXPECT_EQ(SeenAt(composed, {0, 0, 0.3}), LinearFromSrgb8()[90]);
}

TEST(Composer, MixesTheLightOfRealSurfacesThatMeetInAPixel) {
  // A sunlit shelf a metre above the cube's shadow; its edge runs through the centre of a column.
  constexpr int kColumn = 162, kRow = 90;
  const double edge = (kColumn - kCamera.cx) / kCamera.fx * 2.0;
  const PlacedModel shelf = Place(MakeBox({edge, 0.1, 0.98}, {0.3, 0.3, 1.0}, 0.3F), true);
  const RgbImage composed = Compose({kGround, kCube, shelf}, EvenPicture(160));
  const auto light = [&](int x) { return LinearFromSrgb8()[composed(x, kRow, 1)]; };
  EXPECT_LT(light(kColumn - 1), 0.5 * light(kColumn + 1)) << "shadow beside sunlit shelf";
  EXPECT_NEAR((light(kColumn) - light(kColumn - 1)) / (light(kColumn + 1) - light(kColumn - 1)),
              0.5, 0.05);
}

TEST(Composer, DrawsTheObjectWhereADistortedLensSeesIt) {
  CameraModel camera = kCamera;
  camera.distortion = {-0.3, 0.05, 0.001, -0.001, 0, 0, 0, 0};
  const Vec3 corner{1.2, 0.8, 0.1};
  const PlacedModel block = Place(
      MakeBox({corner.x - 0.2, corner.y - 0.2, 0.0}, {corner.x + 0.2, corner.y + 0.2, 0.1}, 0.9F),
      false);
  const RgbImage composed = Compose({block}, EvenPicture(0), camera);
  // Three millimetres of the scene are a third of a pixel. The edges must lie between 0.17 m and
  // 0.23 m, about three pixels either way.
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_GT(SeenAt(composed, corner + Vec3{sign * 0.17, 0, 0}, camera), 0.2);
    EXPECT_GT(SeenAt(composed, corner + Vec3{0, sign * 0.17, 0}, camera), 0.2);
    EXPECT_EQ(SeenAt(composed, corner + Vec3{sign * 0.25, 0, 0}, camera), 0.0);
    EXPECT_EQ(SeenAt(composed, corner + Vec3{0, sign * 0.25, 0}, camera), 0.0);
  }
}

TEST(Composer, CastsNoShadowWithoutASun) {
  const RgbImage picture = EvenPicture(200);
  const double before = LinearFromSrgb8()[200];
  const RgbImage composed = Compose({kGround, kCube}, picture, kCamera, 0.0);
  EXPECT_NEAR(SeenAt(composed, {0, 0.30, 0}) / before, SeenAt(composed, {0, -0.30, 0}) / before,
              0.03);
  EXPECT_LT(SeenAt(composed, {0, 0.17, 0}) / before, 0.85);
}

TEST(Composer, TintsPartitionsAndShowsTheMapsInTheDebugView) {
  ComposerOptions options;
  options.show_shadow_maps = true;
  const RgbImage plain = Compose({kGround, kCube}, EvenPicture(200));
  const RgbImage shown = Compose({kGround, kCube}, EvenPicture(200), kCamera, kSunLux, options);
  // Beside the cube, in the finest partition: red. Far away, in the second: green.
  const int x = 159, near_y = 110, far_y = 8;
  EXPECT_EQ(shown(x, near_y, 0), plain(x, near_y, 0));
  EXPECT_NEAR(shown(x, near_y, 1), 0.45 * plain(x, near_y, 1), 2);
  EXPECT_NEAR(shown(x, far_y, 0), 0.5 * plain(x, far_y, 0), 2);
  EXPECT_EQ(shown(x, far_y, 1), plain(x, far_y, 1));
  // The depth maps: the cube is nearer to the sun and therefore darker than the ground.
  int darkest = 255, brightest = 0;
  for (int y = kCamera.height - 60; y < kCamera.height - 4; ++y) {
    for (int column = 4; column < 60; ++column) {
      darkest = std::min<int>(darkest, shown(column, y, 0));
      brightest = std::max<int>(brightest, shown(column, y, 0));
    }
  }
  EXPECT_LT(darkest, brightest - 20);
}

TEST(Composer, DrawsShadowMapsOfTheSizesAskedFor) {
  ComposerOptions options;
  options.shadow_method = ShadowMethod::kPlain;
  const RgbImage fine = Compose({kGround, kCube}, EvenPicture(200), kCamera, kSunLux, options);
  options.shadow_sizes = {32, 32, 32, 32};
  const RgbImage coarse = Compose({kGround, kCube}, EvenPicture(200), kCamera, kSunLux, options);
  int differing = 0;
  for (int y = 0; y < kCamera.height; ++y) {
    for (int x = 0; x < kCamera.width; ++x) differing += fine(x, y, 1) != coarse(x, y, 1);
  }
  EXPECT_GT(differing, 100) << "the shadow's edge follows the texels";
  options.shadow_method = ComposerOptions{}.shadow_method;
  options.shadow_sizes[1] = 100;  // Maps of this method have a pyramid, which needs powers of two.
  const auto refused = Composer::Create(kCamera, {kGround, kCube}, options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
}

TEST(Composer, DrawsAfterAChangeOfOptionsAsOneMadeWithThem) {
  const std::vector<PlacedModel> scene{kGround, kCube};
  const auto composer = LitComposer(scene, SouthernSun());
  const RgbImage picture = EvenPicture(200);
  // Unchanged maps, then finer ones for a wide image (1280 pixels), then coarser ones on request.
  // Then another method, and the first one again.
  ComposerOptions half, large, sized, paper;
  half.supersampling = 0.5;
  large.supersampling = 4.0;
  sized.shadow_sizes = {256, 256, 256, 256};
  paper.shadow_method = ShadowMethod::kGaussian;
  for (const ComposerOptions& options : {half, large, sized, paper, ComposerOptions{}}) {
    ASSERT_TRUE(composer->SetOptions(options));
    const auto changed = composer->Compose(picture.view(), kFromAbove,
                                           {kExposureScale, kExposureScale, kExposureScale});
    ASSERT_TRUE(changed.has_value());
    const RgbImage made = Compose(scene, picture, kCamera, kSunLux, options);
    EXPECT_TRUE(std::equal(made.data(), made.data() + made.size(), changed->data()));
  }
}

TEST(Composer, CastsTheSameShadowByThePapersMethod) {
  ComposerOptions options;
  options.shadow_method = ShadowMethod::kGaussian;
  const RgbImage picture = EvenPicture(200);
  const RgbImage paper = Compose({kGround, kCube}, picture, kCamera, kSunLux, options);
  const RgbImage ours = Compose({kGround, kCube}, picture);
  EXPECT_NEAR(SeenAt(paper, {0, 0.28, 0}), SeenAt(ours, {0, 0.28, 0}), 0.06);
  EXPECT_NEAR(SeenAt(paper, {0, 0.8, 0}), SeenAt(ours, {0, 0.8, 0}), 0.06);
}

/// Width of a white slab's edge in the image: standard deviation of the steps across it, in linear
/// light and pixels.
double EdgeSpread(const RgbImage& picture, int row) {
  double all = 0.0, mean = 0.0, square = 0.0;
  for (int x = 100; x < 159; ++x) {
    const double step = static_cast<double>(LinearFromSrgb8()[picture(x + 1, row, 1)]) -
                        LinearFromSrgb8()[picture(x, row, 1)];
    all += step;
    mean += step * x;
    square += step * x * x;
  }
  mean /= all;
  return std::sqrt(square / all - mean * mean);
}

TEST(Composer, BlursWhatIsDrawnAsTheCameraDoes) {
  const PlacedModel slab = Place(MakeBox({-0.304, -0.8, 0.1}, {0.8, 0.8, 0.1}, 0.8F), false);
  const RgbImage black = EvenPicture(0);
  for (const double blur_px : {0.8, 2.0, 4.0}) {
    CameraLook look;
    look.blur_px = blur_px;
    const RgbImage composed = Compose({slab}, black, kCamera, kSunLux, {}, look);
    EXPECT_NEAR(EdgeSpread(composed, 120), blur_px, 0.06 * blur_px + 0.05);
    EXPECT_EQ(composed(2, 2, 1), 0);
  }
  // At the camera's position the edge is as sharp as a pixel.
  CameraLook sharp;
  sharp.blur_px = 0.3;
  EXPECT_LT(EdgeSpread(Compose({slab}, black, kCamera, kSunLux, {}, sharp), 120), 0.55);
}

TEST(Composer, GivesWhatIsDrawnTheCamerasGrain) {
  const PlacedModel slab = Place(MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.3F), false);
  CameraLook look;
  look.blur_px = 0.3;
  look.noise_constant = {2e-5, 2e-5, 2e-5};
  look.noise_slope = {4e-4, 4e-4, 4e-4};
  look.channel_correlation = 0.5;
  const RgbImage picture = EvenPicture(60);
  const RgbImage composed = Compose({slab}, picture, kCamera, kSunLux, {}, look);
  double mean = 0.0, square = 0.0, count = 0.0, crossed = 0.0, red_mean = 0.0;
  for (int y = 90; y < 150; ++y) {
    for (int x = 130; x < 190; ++x) {
      const double green = LinearFromSrgb8()[composed(x, y, 1)];
      const double red = LinearFromSrgb8()[composed(x, y, 0)];
      mean += green;
      red_mean += red;
      square += green * green;
      crossed += green * red;
      ++count;
    }
  }
  mean /= count;
  red_mean /= count;
  const double variance = square / count - mean * mean;
  EXPECT_NEAR(variance / (2e-5 + 4e-4 * mean), 1.0, 0.1);
  EXPECT_NEAR((crossed / count - mean * red_mean) / variance, 0.5, 0.1);
  // The camera image is already blurred.
  EXPECT_EQ(composed(10, 10, 1), 60);
}

TEST(Composer, ReadsAndWritesTheCamerasOwnCodes) {
  // A camera whose pixel values are linear light.
  ComposerOptions options;
  const std::vector<double> ends{0.0, 1.0};
  options.response = *CameraResponse::FromSamples(ends, {ends, ends, ends});
  const RgbImage composed = Compose({kGround, kCube}, EvenPicture(128), kCamera, kSunLux, options);
  const auto seen = [&](Vec3 point) {
    const Vec2 pixel = ProjectToPixel(kCamera, kFromAbove * Point<Marker>{point});
    return composed(static_cast<int>(std::lround(pixel.x)), static_cast<int>(std::lround(pixel.y)),
                    1) /
           255.0;
  };
  const double lux = kSkyLux + kSunLux * std::numbers::sqrt2 / 2;
  EXPECT_NEAR(seen({0, 0, 0.3}), kExposureScale * 0.5 * lux / std::numbers::pi, 0.01);
  // The shadow keeps the same share of the light as with any other response.
  const double share = seen({0, 0.30, 0}) / (128 / 255.0);
  const RgbImage srgb = Compose({kGround, kCube}, EvenPicture(188));
  EXPECT_NEAR(share, SeenAt(srgb, {0, 0.30, 0}) / LinearFromSrgb8()[188], 0.02);
  EXPECT_EQ(composed(2, 2, 0), 128);
}

}  // namespace
}  // namespace pleinair::compositor
