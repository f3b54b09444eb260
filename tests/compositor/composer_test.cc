// The renderer on small scenes whose light can be worked out by hand.

#include "compositor/composer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "base/srgb.h"
#include "compositor/render_camera.h"
#include "compositor/scene_view.h"
#include "shadows/splits.h"

namespace pleinair::compositor {
namespace {

constexpr double kSkyLux = 20000, kSunLux = 80000;

/// An even sky and a sun in the south, 45° high, or no sun at all.
class SouthernSun : public sky::SkyModel {
 public:
  explicit SouthernSun(double sun_lux = kSunLux) : sun_lux_(sun_lux) {}
  LinearRgb SkyRadiance(Direction<World>) const override {
    return LinearRgb{kSkyLux, kSkyLux, kSkyLux} * std::numbers::inv_pi;
  }
  LinearRgb SunNormalIrradiance() const override { return {sun_lux_, sun_lux_, sun_lux_}; }
  LinearRgb SkyHorizontalIrradiance() const override { return {kSkyLux, kSkyLux, kSkyLux}; }
  Direction<World> ToSun() const override {
    return {{0, -std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2}};
  }

 private:
  double sun_lux_;
};

/// An axis-aligned box, or with zero height an upward rectangle.
Model MakeBox(Vec3 low, Vec3 high, float albedo) {
  Model model;
  Material material;
  material.base_color = {albedo, albedo, albedo};
  model.materials.push_back(material);
  Mesh mesh;
  const auto face = [&](Vec3 origin, Vec3 u, Vec3 v) {
    const Vec3 normal = Normalized(Cross(u, v));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : {origin, origin + u, origin + u + v, origin + v}) {
      mesh.positions.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      mesh.normals.push_back({static_cast<float>(normal.x), static_cast<float>(normal.y),
                              static_cast<float>(normal.z)});
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
  };
  const Vec3 dx{high.x - low.x, 0, 0}, dy{0, high.y - low.y, 0}, dz{0, 0, high.z - low.z};
  face(low + dz, dx, dy);
  if (dz.z > 0.0) {
    face(low, dy, dx);
    face(low, dx, dz);
    face(low + dx, dy, dz);
    face(low + dx + dy, dx * -1.0, dz);
    face(low + dy, dy * -1.0, dz);
  }
  model.meshes.push_back(std::move(mesh));
  return model;
}

PlacedModel Place(const Model& model, bool is_phantom) {
  return {std::make_shared<const Model>(model), Mat3{}, {}, is_phantom};
}

const CameraModel kCamera{
    .width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 159.5, .cy = 119.5};
// Three metres above the marker, looking straight down; picture up is the marker's +y (north).
const Transform<Camera, Marker> kFromAbove{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 3}};
// Display-linear value per radiance: white ground in full light shows as 0.8.
const double kGain = 0.8 * std::numbers::pi / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);

const PlacedModel kGround = Place(MakeBox({-4, -4, 0}, {4, 4, 0}, 0.3F), true);
const PlacedModel kCube = Place(MakeBox({-0.15, -0.15, 0.001}, {0.15, 0.15, 0.3}, 0.5F), false);

RgbImage Compose(const std::vector<PlacedModel>& scene, const RgbImage& picture,
                 const CameraModel& camera = kCamera, double sun_lux = kSunLux,
                 ComposerOptions options = {}, const std::optional<PictureLook>& look = {},
                 bool look_for_shade = true) {
  LightSolverOptions solver_options;
  solver_options.rays_per_vertex = 64;
  const auto solver = LightSolver::Create(scene, solver_options);
  if (!solver) ADD_FAILURE() << solver.error().Message();
  auto composer = Composer::Create(camera, scene, options);
  if (!composer) ADD_FAILURE() << composer.error().Message();
  (*composer)->LookForShade(look_for_shade);
  const SouthernSun light(sun_lux);
  const auto set = (*composer)->SetLight((*solver)->Solve(light, Mat3{}), light, Mat3{});
  if (!set) ADD_FAILURE() << set.error().Message();
  if (const auto looks = (*composer)->SetLook(look); !looks) {
    ADD_FAILURE() << looks.error().Message();
  }
  auto composed = (*composer)->Compose(picture.view(), kFromAbove, {kGain, kGain, kGain});
  if (!composed) ADD_FAILURE() << composed.error().Message();
  return *std::move(composed);
}

RgbImage EvenPicture(std::uint8_t code) {
  RgbImage picture(kCamera.width, kCamera.height, 3);
  std::fill_n(picture.data(), picture.size(), code);
  return picture;
}

/// Linear value of the green channel where a point of the scene is seen.
double SeenAt(const RgbImage& picture, Vec3 point, const CameraModel& camera = kCamera) {
  const Vec2 pixel = ProjectToPixel(camera, kFromAbove * Point<Marker>{point});
  return LinearFromSrgb8()[picture(static_cast<int>(std::lround(pixel.x)),
                                   static_cast<int>(std::lround(pixel.y)), 1)];
}

TEST(Composer, KeepsTheBytesThatNoVirtualThingTouches) {
  RgbImage noise(kCamera.width, kCamera.height, 3);
  std::mt19937 random(7);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    noise.data()[i] = static_cast<std::uint8_t>(random() & 0xFFU);
  }
  // The cube without real surfaces: nothing but its own pixels can change.
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
  EXPECT_NEAR(SeenAt(composed, {0, 0, 0.3}), kGain * 0.5 * lux / std::numbers::pi, 0.01);
}

TEST(Composer, CastsTheShadowAwayFromTheSunAndLeavesTheSkysShare) {
  const RgbImage picture = EvenPicture(200);
  const double before = LinearFromSrgb8()[200];
  const RgbImage composed = Compose({kGround, kCube}, picture);
  // The sun stands in the south: the shadow reaches 0.3 m to the north of the cube.
  const double share = SeenAt(composed, {0, 0.30, 0}) / before;
  const double sky_share = kSkyLux / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);
  EXPECT_LT(share, sky_share);
  EXPECT_GT(share, 0.5 * sky_share);
  // Just beyond the shadow's end and to the south there is but a little less sky.
  EXPECT_NEAR(SeenAt(composed, {0, 0.60, 0}) / before, 1.0, 0.04);
  EXPECT_NEAR(SeenAt(composed, {0.6, 0.3, 0}) / before, 1.0, 0.04);
}

TEST(Composer, NeverDarkensARealShadowTwice) {
  // A real wall in the south keeps the sun from everything that the cube could shade.
  const PlacedModel wall = Place(MakeBox({-3, -0.8, 0}, {3, -0.7, 2.5}, 0.3F), true);
  const RgbImage picture = EvenPicture(120);
  const double before = LinearFromSrgb8()[120];
  const RgbImage composed = Compose({kGround, wall, kCube}, picture);
  // Darkened by a shadow of the cube's own it would keep a quarter.
  EXPECT_NEAR(SeenAt(composed, {0, 0.35, 0}) / before, 0.95, 0.1);
  EXPECT_NEAR(SeenAt(composed, {0, 0.8, 0}) / before, 1.0, 0.04);
}

TEST(Composer, DarkensNothingThatATreeShadesAlready) {
  // West of the middle the ground lies in the shade of something that no phantom stands for.
  const double lit = 0.3 * 0.8;
  const double shade = lit * kSkyLux / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);
  RgbImage picture = EvenPicture(Srgb8FromLinear(lit));
  for (int y = 0; y < picture.height(); ++y) {
    std::fill_n(picture.view().row(y), 3 * picture.width() / 2, Srgb8FromLinear(shade));
  }
  // Both in the cube's shadow, clear of the tree's edge.
  const Vec3 sunlit{0.08, 0.32, 0.0}, shaded{-0.08, 0.32, 0.0};
  const RgbImage composed = Compose({kGround, kCube}, picture);
  EXPECT_LT(SeenAt(composed, sunlit), 1.1 * shade);
  EXPECT_GT(SeenAt(composed, shaded), 0.75 * shade) << "the cube takes some of the sky";
  // Where pictures are not asked, the tree's shade is darkened as sunlit ground is.
  const RgbImage unasked = Compose({kGround, kCube}, picture, kCamera, kSunLux, {}, {}, false);
  EXPECT_NEAR(SeenAt(unasked, sunlit), SeenAt(composed, sunlit), 0.02);
  EXPECT_LT(SeenAt(unasked, shaded), 0.4 * shade);
}

TEST(Composer, ShadesTheObjectWhereARealWallKeepsTheSunFromIt) {
  const PlacedModel wall = Place(MakeBox({-3, -0.8, 0}, {3, -0.7, 2.5}, 0.3F), true);
  const double sky_alone = kGain * 0.5 * kSkyLux / std::numbers::pi;
  const double shaded = SeenAt(Compose({kGround, wall, kCube}, EvenPicture(120)), {0, 0, 0.3});
  EXPECT_LT(shaded, 1.05 * sky_alone);
  EXPECT_GT(shaded, 0.5 * sky_alone);  // The wall hides some of the sky.
}

TEST(Composer, HidesTheObjectBehindAPhantom) {
  const PlacedModel table = Place(MakeBox({-1, -1, 0.8}, {1, 1, 0.85}, 0.3F), true);
  const RgbImage picture = EvenPicture(90);
  const RgbImage composed = Compose({kGround, table, kCube}, picture);
  EXPECT_EQ(SeenAt(composed, {0, 0, 0.3}), LinearFromSrgb8()[90]);
}

TEST(Composer, DrawsTheObjectWhereADistortedLensSeesIt) {
  CameraModel camera = kCamera;
  camera.distortion = {-0.3, 0.05, 0.001, -0.001, 0, 0, 0, 0};
  const Vec3 corner{1.2, 0.8, 0.1};
  const PlacedModel block = Place(
      MakeBox({corner.x - 0.2, corner.y - 0.2, 0.0}, {corner.x + 0.2, corner.y + 0.2, 0.1}, 0.9F),
      false);
  const RgbImage composed = Compose({block}, EvenPicture(0), camera);
  // Three millimetres of the scene are a third of a pixel: the edges must lie between 0.17 m and
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

/// The same light in air so thick that half of what is three metres away is seen.
class HazySouthernSun : public SouthernSun {
 public:
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const double left = std::exp2(-distance.value() / 3.0);
    return {{left, left, left}, LinearRgb{1.0, 1.0, 1.0} * (kAirlight * (1.0 - left))};
  }
  static constexpr double kAirlight = 6000.0;
};

TEST(Composer, SeesTheObjectThroughAsMuchFogAsItIsToldTo) {
  const SouthernSun clear;
  const HazySouthernSun hazy;
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
    EXPECT_TRUE((*composer)->SetLight(lit, day, Mat3{}));
    const auto composed =
        (*composer)->Compose(EvenPicture(128).view(), kFromAbove, {kGain, kGain, kGain});
    return SeenAt(*composed, {0, 0, 0.3});
  };
  const double plain = top(clear, 1.0);
  EXPECT_EQ(top(hazy, 0.0), plain);
  for (const double fog : {1.0, 2.0}) {
    const double left = std::exp2(-fog * 2.7 / 3.0);
    EXPECT_NEAR(top(hazy, fog), plain * left + kGain * HazySouthernSun::kAirlight * (1.0 - left),
                0.02)
        << fog;
  }
}

TEST(Composer, DrawsFogOfDifferentPartitionsWithoutASeam) {
  // A virtual lawn from under the camera to the horizon, and its fog by the formula.
  const std::vector<PlacedModel> scene{Place(MakeBox({-400, -400, 0}, {400, 400, 0}, 0.5F), false)};
  const Transform<Camera, Marker> eye_level{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {0, 2, 0}};
  const HazySouthernSun day;
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 16, .near_edge_m = 100.0});
  ASSERT_TRUE(solver.has_value());
  ComposerOptions options;
  options.shadow_partitions = 4;
  options.fog = {0.0, 0.06, 0.005, 0.02};
  auto composer = Composer::Create(kCamera, scene, options);
  ASSERT_TRUE(composer.has_value());
  ASSERT_TRUE((*composer)->SetLight((*solver)->Solve(day, Mat3{}), day, Mat3{}));
  const auto composed =
      (*composer)->Compose(EvenPicture(0).view(), eye_level, {kGain, kGain, kGain});
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
    EXPECT_NEAR(seen, kGain * (radiance * left + HazySouthernSun::kAirlight * (1.0 - left)), 0.02)
        << "row " << y << ", " << distance << " m";
    // Fog may thicken from row to row; a seam would be a step.
    if (last >= 0.0 && distance < 60.0) {
      EXPECT_NEAR(seen, last, 0.02) << "row " << y;
    }
    last = seen;
  }
  EXPECT_GE(partitions_seen, 3);
}

/// The same light in air that leaves 60 % of what is 200 m away.
class HazySouthernField : public SouthernSun {
 public:
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const double left = std::pow(kLeft, distance.value() / 200.0);
    return {{left, left, left}, LinearRgb{1.0, 1.0, 1.0} * (kAirlight * (1.0 - left))};
  }
  static constexpr double kLeft = 0.6, kAirlight = 6000.0;
  /// How a surface 200 m away shows.
  static double Shown(double radiance) {
    return kGain * (radiance * kLeft + kAirlight * (1.0 - kLeft));
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
  ASSERT_TRUE((*composer)->SetLight(lit, day, Mat3{}));
  const auto shadow = [&](double picture, double fog) {
    ComposerOptions options;
    options.fog.fill(fog);
    EXPECT_TRUE((*composer)->SetOptions(options));
    const auto code = static_cast<std::uint8_t>(std::lround(255.0 * SrgbFromLinear(picture)));
    const auto composed =
        (*composer)->Compose(EvenPicture(code).view(), from_far_above, {kGain, kGain, kGain});
    const Vec2 pixel = ProjectToPixel(kCamera, from_far_above * Point<Marker>{{0, 20, 0}});
    return LinearFromSrgb8()[(*composed)(static_cast<int>(std::lround(pixel.x)),
                                         static_cast<int>(std::lround(pixel.y)), 1)];
  };
  const double sunlit = 0.3 * (kSkyLux + kSunLux * std::numbers::sqrt2 / 2) / std::numbers::pi;
  // As a near picture would have it, to know what the tower leaves of the light.
  const double ratio = shadow(kGain * sunlit, 0.0) / (kGain * sunlit);
  EXPECT_NEAR(ratio, 0.23, 0.06);
  EXPECT_NEAR(shadow(HazySouthernField::Shown(sunlit), 1.0),
              HazySouthernField::Shown(ratio * sunlit), 0.006);
  EXPECT_LT(shadow(HazySouthernField::Shown(sunlit), 0.0),
            HazySouthernField::Shown(ratio * sunlit) - 0.04);
  // Half the air: half the optical depth.
  const double left = std::sqrt(HazySouthernField::kLeft);
  const double air = kGain * HazySouthernField::kAirlight * (1.0 - left);
  EXPECT_NEAR(shadow(kGain * sunlit * left + air, 0.5), kGain * ratio * sunlit * left + air, 0.006);
  // Shade that the picture has there already is known for it through the haze.
  const double shaded = HazySouthernField::Shown(0.3 * kSkyLux / std::numbers::pi);
  EXPECT_NEAR(shadow(shaded, 1.0), shaded, 0.015);
  EXPECT_LT(shadow(shaded, 0.0), 0.7 * shaded);
}

TEST(Composer, TintsPartitionsAndShowsTheMapsInTheDebugView) {
  ComposerOptions options;
  options.show_shadow_maps = true;
  const RgbImage plain = Compose({kGround, kCube}, EvenPicture(200));
  const RgbImage shown = Compose({kGround, kCube}, EvenPicture(200), kCamera, kSunLux, options);
  // Beside the cube, in the finest partition: red. Far off, in the second: green.
  const int x = 159, near_y = 110, far_y = 8;
  EXPECT_EQ(shown(x, near_y, 0), plain(x, near_y, 0));
  EXPECT_NEAR(shown(x, near_y, 1), 0.45 * plain(x, near_y, 1), 2);
  EXPECT_NEAR(shown(x, far_y, 0), 0.5 * plain(x, far_y, 0), 2);
  EXPECT_EQ(shown(x, far_y, 1), plain(x, far_y, 1));
  // The maps: the cube nearer to the sun, hence darker than the ground around it.
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
  options.shadow_sizes[1] = 100;
  const auto refused = Composer::Create(kCamera, {kGround, kCube}, options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
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

/// A white slab's edge as the picture spreads it: standard deviation of the steps across it, in
/// linear light and pixels.
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
    PictureLook look;
    look.blur_px = blur_px;
    const RgbImage composed = Compose({slab}, black, kCamera, kSunLux, {}, look);
    EXPECT_NEAR(EdgeSpread(composed, 120), blur_px, 0.06 * blur_px + 0.05);
    EXPECT_EQ(composed(2, 2, 1), 0);
  }
  // As sharp as a pixel is wide, where the camera is.
  PictureLook sharp;
  sharp.blur_px = 0.3;
  EXPECT_LT(EdgeSpread(Compose({slab}, black, kCamera, kSunLux, {}, sharp), 120), 0.55);
}

TEST(Composer, GivesWhatIsDrawnTheCamerasGrain) {
  const PlacedModel slab = Place(MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.3F), false);
  PictureLook look;
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
  // The camera's own pixels have theirs already.
  EXPECT_EQ(composed(10, 10, 1), 60);
}

TEST(Composer, ReadsAndWritesTheCamerasOwnCodes) {
  // A camera whose codes are light itself.
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
  EXPECT_NEAR(seen({0, 0, 0.3}), kGain * 0.5 * lux / std::numbers::pi, 0.01);
  // The same share of the light is left in the shadow as with any other codes.
  const double share = seen({0, 0.30, 0}) / (128 / 255.0);
  const RgbImage srgb = Compose({kGround, kCube}, EvenPicture(188));
  EXPECT_NEAR(share, SeenAt(srgb, {0, 0.30, 0}) / LinearFromSrgb8()[188], 0.02);
  EXPECT_EQ(composed(2, 2, 0), 128);
}

}  // namespace
}  // namespace pleinair::compositor
