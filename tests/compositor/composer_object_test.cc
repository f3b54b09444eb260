// Tests the pixels of virtual objects: material, texture and partial coverage.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "base/srgb.h"
#include "compositor/composer.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/models/alpha_cutout.h"
#include "tests/compositor/composer_scene.h"
#include "tests/compositor/gentle_response.h"

namespace pleinair::compositor {
namespace {

/// A level square of 1 m, 0.1 m above the marker. Its texture's u runs along x, v against y.
Model TexturedSquare(Image<std::uint8_t> texture) {
  Model square = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 1.0F);
  square.meshes[0].uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  square.materials[0].base_color_texture = 0;
  square.textures.push_back(std::move(texture));
  return square;
}

TEST(Composer, ColorsAnObjectByItsTextureAndLeavesTheCameraWhatIsCutOut) {
  constexpr int kSide = 64;
  const std::uint8_t dark = Srgb8FromLinear(0.1), bright = Srgb8FromLinear(0.6);
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (int c = 0; c < 3; ++c) texture(x, y, c) = x < kSide / 2 ? dark : bright;
      texture(x, y, 3) = x < kSide / 2 && y < kSide / 2 ? 0 : 255;  // North-west.
    }
  }
  const RgbImage composed =
      Compose({Place(TexturedSquare(std::move(texture)), false), kCube}, EvenPicture(77));
  EXPECT_NEAR(SeenAt(composed, {-0.35, -0.25, 0.1}), Level(0.1), 0.01);
  EXPECT_NEAR(SeenAt(composed, {0.35, -0.25, 0.1}), Level(0.6), 0.02);
  EXPECT_NEAR(SeenAt(composed, {0.35, 0.35, 0.1}), Level(0.6), 0.02);
  EXPECT_EQ(SeenAt(composed, {-0.35, 0.35, 0.1}), LinearFromSrgb8()[77]);
  // An adjacent object without a texture keeps its own color.
  EXPECT_NEAR(SeenAt(composed, {0, 0, 0.3}), Level(0.5), 0.02);
}

TEST(Composer, DrawsShadowsAtTheDepthOfTheFilm) {
  constexpr int kCode = 150;
  for (const bool is_srgb : {true, false}) {
    ComposerOptions options;
    if (!is_srgb) options.response = testing::GentleResponse();
    const std::vector<PlacedModel> scene{kGround, kCube};
    const auto compose = [&](CameraImageView picture) {
      return Compose(scene, picture, kCamera, kSunLux, options, {}, false);
    };
    const RgbImage below = EvenPicture(kCode), above = EvenPicture(kCode + 1);
    DeepImage between(kCamera.width, kCamera.height, 3);
    std::fill_n(between.data(), between.size(), static_cast<std::uint16_t>(257 * kCode + 64));
    const RgbImage low = compose(below.view()), high = compose(above.view());
    const RgbImage deep = compose({below.view(), std::as_const(between).view()});
    // The mean of many ratios: it does not go in steps.
    double low_sum = 0.0, high_sum = 0.0, deep_sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < low.size(); ++i) {
      if (low.data()[i] >= kCode - 5) continue;
      low_sum += low.data()[i];
      high_sum += high.data()[i];
      deep_sum += deep.data()[i];
      ++count;
    }
    ASSERT_GT(count, 1000);
    EXPECT_NEAR(deep_sum / count, (0.75 * low_sum + 0.25 * high_sum) / count, 0.1) << is_srgb;
    EXPECT_GT(deep_sum / count, low_sum / count + 0.05) << is_srgb;
  }
}

TEST(Composer, SmoothsASlantedEdgeInFourSteps) {
  // Black in front of white, slightly turned. In linear light a pixel keeps the uncovered share of
  // white, in quarters.
  const double c = std::cos(0.1), s = std::sin(0.1);
  const PlacedModel square{
      std::make_shared<const Model>(MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.0F)),
      Mat3{{c, -s, 0, s, c, 0, 0, 0, 1}},
      {},
      false};
  constexpr std::uint8_t kWhite = 200;
  ComposerOptions four_samples;
  four_samples.antialiasing.method = AntialiasingMethod::kMultisample;
  const RgbImage composed = Compose({square}, EvenPicture(kWhite), kCamera, kSunLux, four_samples);
  std::array<int, 5> pixels{};  // By covered quarters.
  for (int y = 0; y < composed.height(); ++y) {
    for (int x = 0; x < composed.width(); ++x) {
      const double covered = 1 - LinearFromSrgb8()[composed(x, y, 1)] / LinearFromSrgb8()[kWhite];
      const auto quarters = std::lround(4 * covered);
      EXPECT_NEAR(4 * covered, quarters, 0.1) << x << ", " << y;
      ++pixels[static_cast<std::size_t>(quarters)];
    }
  }
  // Four edges of some hundred pixels each.
  for (const int quarters : {1, 2, 3}) EXPECT_GT(pixels[quarters], 30) << quarters;
  EXPECT_GT(pixels[0], 1000);
  EXPECT_GT(pixels[4], 1000);
}

TEST(Composer, SeparatesMetalFromPaintByTheTexture) {
  constexpr int kSide = 64;
  Model plate = TexturedSquare(Image<std::uint8_t>(kSide, kSide, 3));
  plate.materials[0].base_color_texture = -1;
  plate.materials[0].metallic_roughness_texture = 0;
  plate.materials[0].base_color = {0.7F, 0.7F, 0.7F};
  plate.materials[0].metallic = 1.0F;
  plate.materials[0].roughness = 0.5F;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      plate.textures[0](x, y, 1) = 51;  // A roughness of 0.1, linear.
      plate.textures[0](x, y, 2) = x < kSide / 2 ? 255 : 0;
    }
  }
  const RgbImage composed = Compose({Place(plate, false)}, EvenPicture(0));
  // The sun, 45° off, is reflected elsewhere unless the surface is rougher.
  EXPECT_NEAR(SeenAt(composed, {-0.3, 0, 0.1}),
              kExposureScale * 0.7 * kSkyLux * std::numbers::inv_pi, 0.01);
  EXPECT_NEAR(SeenAt(composed, {0.3, 0, 0.1}), Level(0.7), 0.01);
}

TEST(Composer, DrawsTheEdgesOfHolesAsFineAsThoseOfSurfaces) {
  // Position of a hole's edge in pixels, from the coverage of a row of pixels. The square moves by
  // fractions of a pixel.
  constexpr int kSide = 64, kRow = 120, kFirst = 130, kLast = 190;
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) texture(x, y, 3) = x < kSide / 2 ? 0 : 255;
  }
  const auto square = std::make_shared<const Model>(TexturedSquare(std::move(texture)));
  const double pixel_m = 2.9 / kCamera.fx;
  const auto covered = [&](double shift_px) {
    const PlacedModel placed{square, Mat3{}, {shift_px * pixel_m, 0, 0}, false};
    const RgbImage composed = Compose({placed}, EvenPicture(200));
    double sum = 0.0;
    for (int x = kFirst; x < kLast; ++x) {
      sum += 1.0 - LinearFromSrgb8()[composed(x, kRow, 1)] / LinearFromSrgb8()[200];
    }
    return sum;
  };
  const double first = covered(0.0);
  EXPECT_NEAR(first, kLast - kCamera.cx - 0.5, 0.3);
  for (const double shift : {0.25, 0.5, 0.75, 1.0}) {
    EXPECT_NEAR(covered(shift), first - shift, 0.15) << shift;
  }
}

TEST(Composer, CoversAsMuchOfAMinifiedCardAsItsTextureDoes) {
  // 24 × 24 cells of a card that is 16 pixels wide. The light solver receives it with the holes cut
  // out.
  constexpr int kSide = 128, kCell = 16, kRepeats = 3;
  const CameraModel small{.width = 80, .height = 60, .fx = 75, .fy = 75, .cx = 39.5, .cy = 29.5};
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) texture(x, y, 3) = (x / kCell + y / kCell) % 2 == 0 ? 255 : 0;
  }
  Model card = TexturedSquare(std::move(texture));
  card.materials[0].base_color = {0, 0, 0};
  const Mesh square = std::exchange(card.meshes[0], {});
  Mesh& mesh = card.meshes[0];
  for (int tile = 0; tile < kRepeats * kRepeats; ++tile) {
    const int column = tile % kRepeats, row = tile / kRepeats;
    for (const std::uint32_t index : square.indices) {
      mesh.indices.push_back(index + static_cast<std::uint32_t>(mesh.positions.size()));
    }
    for (auto [x, y, z] : square.positions) {
      const float across = static_cast<float>(column) - 1.0F;
      const float along = static_cast<float>(row) - 1.0F;
      mesh.positions.push_back({0.2F * (x + across), 0.2F * (y + along), z});
    }
    mesh.normals.insert(mesh.normals.end(), square.normals.begin(), square.normals.end());
    mesh.uvs.insert(mesh.uvs.end(), square.uvs.begin(), square.uvs.end());
  }
  ApplyAlphaCutout(&card);
  ASSERT_EQ(card.meshes.size(), 2U);
  EXPECT_NEAR(LetThrough({Place(card, false)}, small), 0.5, 0.03);
  // If the cut-out geometry were drawn, the holes would count twice.
  card.meshes.pop_back();
  card.meshes[0].role = MeshRole::kAll;
  EXPECT_GT(LetThrough({Place(card, false)}, small), 0.56);
}

TEST(Composer, ShadesTheGroundByWhatIsLeftOfACardAlone) {
  constexpr int kSide = 64;
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool hole = std::max(std::abs(x - kSide / 2), std::abs(y - kSide / 2)) < kSide / 4;
      texture(x, y, 3) = hole ? 0 : 255;
    }
  }
  Model card = TexturedSquare(std::move(texture));
  ApplyAlphaCutout(&card);
  const RgbImage composed = Compose({kGround, Place(card, false)}, EvenPicture(150), kCamera,
                                    kSunLux, {}, {}, /*assume_unmodelled_shadows=*/false);
  const double lit = LinearFromSrgb8()[150];
  // The sun, 45° high in the south, shines through the hole onto the ground visible through it.
  EXPECT_GT(SeenAt(composed, {0, 0.1, 0}), 0.75 * lit);
  EXPECT_LT(SeenAt(composed, {0, 0.57, 0}), 0.4 * lit);
}

TEST(Composer, KeepsTheEdgesOfHolesSharpWhereTexelsAreFinerThanPixels) {
  // Ten texels per pixel. Counts partly covered pixels over positions of a straight edge that lies
  // within one texel of the minified texture.
  constexpr int kSide = 1024, kRow = 120, kFirst = 130, kLast = 190, kPlaces = 4;
  constexpr int kHole = kSide / 2 + 3;
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) texture(x, y, 3) = x < kHole ? 0 : 255;
  }
  const auto square = std::make_shared<const Model>(TexturedSquare(std::move(texture)));
  const double pixel_m = 2.9 / kCamera.fx, bright = LinearFromSrgb8()[200];
  int between = 0;
  double covered = 0.0;
  for (int i = 0; i < kPlaces; ++i) {
    const PlacedModel placed{square, Mat3{}, {i * pixel_m / kPlaces, 0, 0}, false};
    const RgbImage composed = Compose({placed}, EvenPicture(200));
    for (int x = kFirst; x < kLast; ++x) {
      const double share = 1.0 - LinearFromSrgb8()[composed(x, kRow, 1)] / bright;
      const double full = 1.0 - LinearFromSrgb8()[composed(kLast, kRow, 1)] / bright;
      covered += share / full;
      between += share > 0.02 * full && share < 0.98 * full ? 1 : 0;
    }
    covered += static_cast<double>(i) / kPlaces;  // The displacement.
  }
  EXPECT_LE(between, 3);
  EXPECT_NEAR(covered / kPlaces, kLast - kCamera.cx - 0.5 - (kHole / 1024.0 - 0.5) / pixel_m, 0.15);
}

TEST(Composer, SeesTheMeanOfATextureThatIsFinerThanPixels) {
  // About ten texels of a checkered texture per image pixel.
  constexpr int kSide = 1024;
  Image<std::uint8_t> texture(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (int c = 0; c < 3; ++c) texture(x, y, c) = (x + y) % 2 == 0 ? 255 : 0;
    }
  }
  const RgbImage composed =
      Compose({Place(TexturedSquare(std::move(texture)), false)}, EvenPicture(0));
  for (int i = -20; i <= 20; ++i) {
    const double x = 0.02 * i;
    EXPECT_NEAR(SeenAt(composed, {x, 0.1, 0.1}), Level(0.5), 0.015) << x;
  }
}

TEST(Composer, MixesTwoStoreysOfOneSurfaceThatMeetInAPixel) {
  // A sheet steps down by 0.3 m; the upper level's edge projects to the centre of a column. Both
  // levels share vertices and normals. A real wall shades only the lower level.
  constexpr int kColumn = 157, kRow = 105;
  const auto edge = static_cast<float>((kColumn - kCamera.cx) / kCamera.fx * 2.7);
  Model stepped = MakeBox({-0.3, -0.3, 0}, {0.3, 0.3, 0}, 0.5F);
  Mesh& sheet = stepped.meshes[0];
  sheet.positions.clear();
  sheet.indices.clear();
  const std::array<std::pair<float, float>, 4> profile{
      {{-0.3F, 0.0F}, {edge, 0.0F}, {edge, 0.3F}, {0.3F, 0.3F}}};
  for (const auto& [x, z] : profile) {
    sheet.positions.push_back({x, -0.3F, z});
    sheet.positions.push_back({x, 0.3F, z});
  }
  sheet.normals.assign(sheet.positions.size(), {0.0F, 0.0F, 1.0F});
  for (std::uint32_t i = 0; i < 6; i += 2) {
    for (const std::uint32_t corner : {0U, 2U, 3U, 0U, 3U, 1U}) sheet.indices.push_back(i + corner);
  }
  const PlacedModel wall = Place(MakeBox({-3, -0.8, 0}, {3, -0.7, 1.0}, 0.3F), true);
  const RgbImage composed = Compose({Place(stepped, false), wall}, EvenPicture(0));
  const auto light = [&](int x) { return LinearFromSrgb8()[composed(x, kRow, 1)]; };
  EXPECT_LT(light(kColumn - 1), 0.5 * light(kColumn + 1)) << "lower storey beside the upper";
  EXPECT_NEAR((light(kColumn) - light(kColumn - 1)) / (light(kColumn + 1) - light(kColumn - 1)),
              0.5, 0.12)
      << "the step's own shadow darkens its edge a little";
}

TEST(Composer, FindsTheWholePenumbraWithoutAskingAllOfTheSunsWindow) {
  // A board 6 m above the ground has a shadow edge 8 cm wide. It is turned so that the edge crosses
  // the window's cells at every position. Triangles have the size of a cell. A transmittance map
  // without shadows makes the composer treat the whole window as changing.
  Model ground = MakeBox({-1, -1, 0}, {1, 1, 0}, 0.3F);
  Mesh& grid = ground.meshes[0];
  const std::array<float, 3> up = grid.normals[0];
  constexpr int kHalf = 20, kSide = 2 * kHalf;
  grid.positions.clear();
  grid.indices.clear();
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      grid.positions.push_back(
          {0.05F * static_cast<float>(x - kHalf), 0.05F * static_cast<float>(y - kHalf), 0.0F});
    }
  }
  grid.normals.assign(grid.positions.size(), up);
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t i = y * (kSide + 1) + x;
      for (const std::uint32_t corner : {0U, 1U, kSide + 2U, 0U, kSide + 2U, kSide + 1U}) {
        grid.indices.push_back(i + corner);
      }
    }
  }
  constexpr double kCos = 0.955, kSin = 0.296;
  const Model board = MakeBox({-0.6, -0.15, 0}, {0.6, 0.15, 0.02}, 0.5F);
  const PlacedModel turned{std::make_shared<const Model>(board),
                           {{kCos, -kSin, 0, kSin, kCos, 0, 0, 0, 1}},
                           {0, -6, 6},
                           false};
  const std::vector<PlacedModel> scene{Place(ground, true), turned};
  const auto composer = ComposerInTheSun(scene);
  const auto compose = [&] {
    return composer->Compose(EvenPicture(200).view(), kFromAbove,
                             {kExposureScale, kExposureScale, kExposureScale});
  };
  const auto footprint = compose();
  auto sunny = std::make_shared<SunTransmittanceMap>();
  sunny->across_x = {1, 0, 0};
  sunny->across_y = {0, 1, 0};
  sunny->cell_m = 1.0;
  sunny->width = sunny->height = 1;
  sunny->share = {1.0F};
  ASSERT_TRUE(composer->SetSunTransmittance({.trees = sunny}));
  const auto whole = compose();
  ASSERT_TRUE(footprint.has_value());
  ASSERT_TRUE(whole.has_value());
  EXPECT_LT(SeenAt(*footprint, {0, 0, 0}), 0.4 * LinearFromSrgb8()[200]);
  int most = 0;
  for (std::size_t i = 0; i < whole->size(); ++i) {
    most = std::max(most, std::abs(footprint->data()[i] - whole->data()[i]));
  }
  EXPECT_LE(most, 1) << "codes";
}

TEST(Composer, LeavesDepthAndBlendingAsDrawingBegins) {
  auto composer = Composer::Create(kCamera, {kCube}, {});
  const auto solver = LightSolver::Create({kCube}, {.rays_per_vertex = 16});
  ASSERT_TRUE(composer.has_value());
  ASSERT_TRUE(solver.has_value());
  const SouthernSun light;
  ASSERT_TRUE((*composer)->SetLight((*solver)->Solve(light, Mat3{}), light, Mat3{},
                                    (*solver)->RadianceFromBelow(light, Mat3{})));
  ASSERT_TRUE((*composer)->Compose(EvenPicture(77).view(), kFromAbove,
                                   {kExposureScale, kExposureScale, kExposureScale}));
  GLint depth_function = 0;
  glGetIntegerv(GL_DEPTH_FUNC, &depth_function);
  EXPECT_EQ(depth_function, GL_LESS);
  GLboolean writes_depth = GL_FALSE;
  glGetBooleanv(GL_DEPTH_WRITEMASK, &writes_depth);
  EXPECT_TRUE(writes_depth);
  EXPECT_FALSE(glIsEnabledi(GL_BLEND, 1));
  EXPECT_FALSE(glIsEnabled(GL_SCISSOR_TEST));
}

}  // namespace
}  // namespace pleinair::compositor
