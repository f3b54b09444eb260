// Tests colors of vertices, bumps, emission, and texture coordinates of their own.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/srgb.h"
#include "compositor/composer.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

constexpr Vec3 kMiddle{0, 0, 0.1};

/// A level square of 1 m, 0.1 m above the marker. Its textures' u runs along x, v against y.
Model Square(float albedo) {
  Model square = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, albedo);
  square.meshes[0].uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return square;
}

Image<std::uint8_t> OneColor(std::array<std::uint8_t, 3> color) {
  Image<std::uint8_t> image(2, 2, 3);
  for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = color[i % 3];
  return image;
}

/// A texel of a normal map.
std::array<std::uint8_t, 3> Bump(Vec3 normal) {
  const auto code = [](double value) {
    return static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * value));
  };
  return {code(normal.x), code(normal.y), code(normal.z)};
}

TEST(ComposerDetail, MultipliesTheColorsOfVertices) {
  Model square = Square(0.8F);
  square.meshes[0].details.resize(4);
  for (const std::size_t west : {0U, 3U})
    square.meshes[0].details[west].color = {0.25, 0.25, 0.25, 1};
  const RgbImage composed = Compose({Place(square, false), kCube}, EvenPicture(0));
  for (const double x : {-0.4, -0.2, 0.3}) {
    EXPECT_NEAR(SeenAt(composed, {x, 0.3, 0.1}), Level(0.8 * (0.625 + 0.75 * x)), 0.02) << x;
  }
  EXPECT_NEAR(SeenAt(composed, {0, 0, 0.3}), Level(0.5), 0.02) << "the cube's vertices are white";
}

TEST(ComposerDetail, TurnsBumpsToTheSunInTheSouth) {
  // Every bump of the square's map faces `bump` (x right in the texture, y up). The square is as
  // bright as one that faces so. The sun is 45° high in the south. The uniform sky hardly counts.
  const auto seen = [](Vec3 bump, double turn_deg, bool back) {
    Model square = Square(0.6F);
    // Turned texture coordinates turn the bumps with them.
    for (auto& [u, v] : square.meshes[0].uvs) {
      const double angle = turn_deg * kRadiansPerDegree;
      const double x = u - 0.5, y = v - 0.5;
      u = static_cast<float>(x * std::cos(angle) + y * std::sin(angle));
      v = static_cast<float>(-x * std::sin(angle) + y * std::cos(angle));
    }
    if (back) {
      for (std::size_t i = 0; i < 6; i += 3) {
        std::swap(square.meshes[0].indices[i + 1], square.meshes[0].indices[i + 2]);
      }
      for (auto& normal : square.meshes[0].normals) normal = {0, 0, -1};
    }
    square.textures.push_back(OneColor(Bump(bump)));
    square.materials[0].detail.normal_map.texture = 0;
    return SeenAt(Compose({Place(square, false)}, EvenPicture(0)), kMiddle);
  };
  const auto expected = [](Vec3 normal) {
    const double cosine = (normal.z - normal.y) * std::numbers::sqrt2 / 2;
    return kExposureScale * 0.6 * std::numbers::inv_pi *
           (kSkyLux * (0.5 + 0.5 * normal.z) + kSunLux * cosine);
  };
  constexpr double kTolerance = 0.04;
  const double c = std::cos(0.4), s = std::sin(0.4);
  EXPECT_NEAR(seen({0, -s, c}, 0, false), expected({0, -s, c}), kTolerance);
  EXPECT_NEAR(seen({0, s, c}, 0, false), expected({0, s, c}), kTolerance);
  // The texture's right points south.
  EXPECT_NEAR(seen({s, 0, c}, 90, false), expected({0, -s, c}), kTolerance);
  // What sticks out of the front goes into the back.
  EXPECT_NEAR(seen({0, -s, c}, 0, true), expected({0, s, c}), kTolerance);
}

TEST(ComposerDetail, ScalesBumps) {
  Model square = Square(0.6F);
  square.textures.push_back(OneColor(Bump({0, -std::sin(0.4), std::cos(0.4)})));
  square.materials[0].detail.normal_map = {0, 0.0F, {}};
  EXPECT_NEAR(SeenAt(Compose({Place(square, false)}, EvenPicture(0)), kMiddle), Level(0.6), 0.02);
}

TEST(ComposerDetail, AddsEmissionInCandelaPerSquareMetre) {
  Model square = Square(0.0F);
  constexpr double kLuminance = 9000.0;
  square.materials[0].detail.emission.luminance_cd_m2.fill(kLuminance);
  const RgbImage plain = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(plain, kMiddle), kLuminance * kExposureScale, 0.01);
  // A texture of its own coordinates: mirrored, bright in the west.
  Image<std::uint8_t> texture(2, 1, 3);
  for (int c = 0; c < 3; ++c) texture(1, 0, c) = 255;
  square.textures.push_back(texture);
  square.materials[0].detail.emission.texture = 0;
  square.materials[0].detail.emission.coordinates = {false, {-1, 0, 0, 1}, {1, 0}};
  const RgbImage textured = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(textured, {-0.25, 0, 0.1}), kLuminance * kExposureScale, 0.01);
  EXPECT_NEAR(SeenAt(textured, {0.25, 0, 0.1}), 0.0, 0.01);
  // The same from the second set.
  square.materials[0].detail.emission.coordinates = {true, {1, 0, 0, 1}, {0, 0}};
  square.meshes[0].details = {{{1, 1}}, {{0, 1}}, {{0, 0}}, {{1, 0}}};
  const RgbImage second = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(second, {-0.25, 0, 0.1}), kLuminance * kExposureScale, 0.01);
  EXPECT_NEAR(SeenAt(second, {0.25, 0, 0.1}), 0.0, 0.01);
}

TEST(ComposerDetail, ReflectsTheSkyInAClearCoat) {
  // A black plate under the sky alone, seen from above: the coat reflects 4 %, a tinted one with a
  // higher index more.
  const double sky = kExposureScale * kSkyLux * std::numbers::inv_pi;
  Model square = Square(0.0F);
  square.materials[0].detail.layers.clearcoat = 1.0F;
  square.materials[0].detail.layers.clearcoat_roughness = 0.1F;
  const RgbImage coated = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(coated, kMiddle), 0.04 * sky, 0.002);
  // Below the coat, white keeps what the coat does not reflect.
  square.materials[0].base_color.fill(1.0F);
  const RgbImage white = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(white, kMiddle), sky, 0.005);
  square.materials[0].base_color.fill(0.0F);
  square.materials[0].detail.layers = {};
  square.materials[0].coat.f0 = 0.8F;
  square.materials[0].roughness = 0.1F;
  square.materials[0].detail.layers.coat_tint = {1.0F, 0.25F, 1.0F};
  const RgbImage tinted = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(tinted, kMiddle), 0.2 * sky, 0.004);
}

TEST(ComposerDetail, AddsSheenAtTheReflectanceOfItsTable) {
  const double sky = kExposureScale * kSkyLux * std::numbers::inv_pi;
  Model square = Square(0.0F);
  square.materials[0].detail.layers.sheen_color.fill(1.0F);
  square.materials[0].detail.layers.sheen_roughness = 1.0F;
  const RgbImage composed = Compose({Place(square, false)}, EvenPicture(0), kCamera, 0.0);
  EXPECT_NEAR(SeenAt(composed, kMiddle), 0.1414 * sky, 0.003);
}

TEST(ComposerDetail, ShowsUnlitSurfacesInTheirOwnColorInSunAndShade) {
  Model square = Square(0.35F);
  square.materials[0].detail.unlit = true;
  for (const double sun_lux : {0.0, kSunLux}) {
    const RgbImage composed = Compose({Place(square, false)}, EvenPicture(0), kCamera, sun_lux);
    EXPECT_NEAR(SeenAt(composed, kMiddle), 0.35, 0.01);
  }
}

}  // namespace
}  // namespace pleinair::compositor
