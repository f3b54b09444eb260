// Antialiasing of composed edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <utility>

#include "compositor/antialiasing.h"
#include "compositor/surfaces/sample_places.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

ComposerOptions Using(AntialiasingMethod method, int places = 64) {
  ComposerOptions options;
  options.antialiasing = {method, places};
  return options;
}

/// A white unlit board above the camera's center, turned by 20°; before black its image is its
/// coverage.
PlacedModel WhiteBoard(double turn_rad = 0.35) {
  Model model = MakeBox({-0.4, -0.25, 0}, {0.4, 0.25, 0}, 1.0F);
  model.materials.front().detail.unlit = true;
  PlacedModel placed = Place(model, false);
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  placed.linear = Mat3{c, -s, 0, s, c, 0, 0, 0, 1};
  return placed;
}

double TotalLight(const RgbImage& image) {
  double sum = 0.0;
  for (std::size_t i = 0; i < image.size(); i += 3) sum += LinearFromSrgb8()[image.data()[i]];
  return sum;
}

/// The board's area in pixels.
const double kBoard_px2 = 0.8 * 0.5 * kCamera.fx * kCamera.fx / 9.0;

TEST(ComposerAntialiasing, ManyPlacesHaveTheAreaOfABoardAndEdgesOfManyLevels) {
  for (const AntialiasingMethod method :
       {AntialiasingMethod::kReference, AntialiasingMethod::kSubpixel}) {
    const RgbImage image = Compose({WhiteBoard()}, EvenPicture(0), kCamera, kSunLux, Using(method));
    EXPECT_NEAR(TotalLight(image) / kBoard_px2, 1.0, 5e-4) << NameOf(method);
    std::array<bool, 256> seen{};
    for (std::size_t i = 0; i < image.size(); i += 3) seen[image.data()[i]] = true;
    EXPECT_GT(std::count(seen.begin(), seen.end(), true), 30) << NameOf(method);
  }
}

/// Root mean square of the difference of linear light, over pixels that differ from black.
double Difference(const RgbImage& image, const RgbImage& truth) {
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double of_truth = LinearFromSrgb8()[truth.data()[i]];
    const double difference = LinearFromSrgb8()[image.data()[i]] - of_truth;
    squares += difference * difference;
    count += of_truth > 0.0 && of_truth < 1.0 ? 1.0 : 0.0;
  }
  return std::sqrt(squares / count);
}

TEST(ComposerAntialiasing, SubpixelHasTheEdgesOfTheReference) {
  const auto draw = [](AntialiasingMethod method, int places) {
    return Compose({WhiteBoard(0.2)}, EvenPicture(0), kCamera, kSunLux, Using(method, places));
  };
  const RgbImage truth = draw(AntialiasingMethod::kReference, 64);
  EXPECT_LT(Difference(draw(AntialiasingMethod::kSubpixel, 64), truth), 0.01);
  EXPECT_LT(Difference(draw(AntialiasingMethod::kSubpixel, 16), truth), 0.05);
  EXPECT_GT(Difference(draw(AntialiasingMethod::kMultisample, 64), truth), 0.07) << "control";
}

TEST(ComposerAntialiasing, SubpixelKeepsTheLightOfWhatMovesOverAPixel) {
  CameraModel camera = kCamera;
  camera.width = 64;
  camera.height = 48;
  camera.cx = 31.5;
  camera.cy = 23.5;
  Model model = MakeBox({-0.06, -0.012, 0}, {0.06, 0.012, 0}, 1.0F);
  model.materials.front().detail.unlit = true;
  PlacedModel placed = Place(model, false);
  placed.linear = Mat3{0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
  const auto composer =
      LitComposer({placed}, SouthernSun(), camera, Using(AntialiasingMethod::kSubpixel));
  RgbImage black(camera.width, camera.height, 3);
  std::fill_n(black.data(), black.size(), std::uint8_t{0});
  const double expected = 0.12 * 0.024 * 100.0 * 100.0;  // 100 pixels a metre.
  constexpr int kSteps = 25;
  for (int step = 0; step < kSteps; ++step) {
    Transform<Camera, Marker> moved = kFromAbove;
    moved.translation_m.x += 0.01 * step / kSteps;
    moved.translation_m.y += 0.004 * step / kSteps;
    const auto image = composer->Compose(black.view(), moved, {1, 1, 1});
    ASSERT_TRUE(image);
    EXPECT_NEAR(TotalLight(*image) / expected, 1.0, 0.003) << step;
  }
  EXPECT_GT(composer->MixedPixels(), 0.005);
  EXPECT_LT(composer->MixedPixels(), 0.1);
}

/// A board 0.3 px wide with a texture that is red everywhere, almost along the image's rows.
PlacedModel RedWire() {
  Model model = MakeBox({-0.9, -0.0015, 0}, {0.9, 0.0015, 0}, 1.0F);
  Image<std::uint8_t> red(2, 2, 3);
  for (std::size_t i = 0; i < red.size(); ++i) red.data()[i] = i % 3 == 0 ? 255 : 0;
  model.textures.push_back(std::move(red));
  model.materials.front().detail.unlit = true;
  model.materials.front().base_color_texture = 0;
  model.materials.front().alpha = Material::Alpha::kIgnored;
  model.meshes.front().uvs.assign(model.meshes.front().positions.size(), {0.5F, 0.5F});
  PlacedModel placed = Place(model, false);
  placed.linear = Mat3{0.999, -0.04471, 0, 0.04471, 0.999, 0, 0, 0, 1};
  return placed;
}

TEST(ComposerAntialiasing, ThinTexturedThingsHaveNoGapsAndTheirColor) {
  const RgbImage image =
      Compose({RedWire()}, EvenPicture(0), kCamera, kSunLux, Using(AntialiasingMethod::kSubpixel));
  // The wire is 0.3 pixels wide. Its columns have that light in the mean, each nearly so.
  constexpr int kFirst = 100, kEnd = 220;
  double sum = 0.0, squares = 0.0;
  for (int x = kFirst; x < kEnd; ++x) {
    double light = 0.0;
    for (int y = 0; y < kCamera.height; ++y) {
      light += LinearFromSrgb8()[image(x, y, 0)];
      EXPECT_EQ(image(x, y, 1), 0) << x << ' ' << y;
    }
    EXPECT_GT(light, 0.2) << x;
    sum += light;
    squares += (light - 0.3) * (light - 0.3);
  }
  EXPECT_NEAR(sum / (kEnd - kFirst), 0.3, 0.006);
  EXPECT_LT(std::sqrt(squares / (kEnd - kFirst)), 0.03);
}

TEST(ComposerAntialiasing, SubpixelCoversObjectsByTheEdgesOfRealThings) {
  // A real plate above the board hides its middle.
  PlacedModel plate = Place(MakeBox({-0.1, -0.6, 0.5}, {0.1, 0.6, 0.5}, 0.3F), true);
  plate.linear = Mat3{0.9689, -0.2474, 0, 0.2474, 0.9689, 0, 0, 0, 1};
  const auto draw = [&](AntialiasingMethod method) {
    return Compose({plate, WhiteBoard()}, EvenPicture(0), kCamera, kSunLux, Using(method));
  };
  const RgbImage truth = draw(AntialiasingMethod::kReference);
  EXPECT_LT(Difference(draw(AntialiasingMethod::kSubpixel), truth), 0.012);
  EXPECT_GT(Difference(draw(AntialiasingMethod::kMultisample), truth), 0.06) << "control";
}

TEST(ComposerAntialiasing, CutOutsKeepTheRenderersSamples) {
  Model model = MakeBox({-0.4, -0.25, 0}, {0.4, 0.25, 0}, 1.0F);
  Image<std::uint8_t> texture(2, 2, 4);
  std::fill_n(texture.data(), texture.size(), std::uint8_t{255});
  texture(0, 0, 3) = 0;
  model.textures.push_back(std::move(texture));
  model.materials.front().detail.unlit = true;
  model.materials.front().base_color_texture = 0;
  model.meshes.front().uvs = {{0.1F, 0.2F}, {0.9F, 0.1F}, {0.8F, 0.9F}, {0.2F, 0.9F}};
  const PlacedModel placed = Place(model, false);
  const auto draw = [&](AntialiasingMethod method) {
    return Compose({placed}, EvenPicture(0), kCamera, kSunLux, Using(method));
  };
  const RgbImage samples = draw(AntialiasingMethod::kMultisample);
  const RgbImage image = draw(AntialiasingMethod::kSubpixel);
  EXPECT_TRUE(std::equal(image.data(), image.data() + image.size(), samples.data()));
}

TEST(ComposerAntialiasing, NoneHasTwoLevelsAndFourSamplesHaveFive) {
  const auto levels = [](AntialiasingMethod method) {
    const RgbImage image = Compose({WhiteBoard()}, EvenPicture(0), kCamera, kSunLux, Using(method));
    std::array<bool, 256> seen{};
    for (std::size_t i = 0; i < image.size(); i += 3) seen[image.data()[i]] = true;
    return std::count(seen.begin(), seen.end(), true);
  };
  EXPECT_EQ(levels(AntialiasingMethod::kNone), 2);
  EXPECT_EQ(levels(AntialiasingMethod::kMultisample), 5);
}

TEST(ComposerAntialiasing, UnaffectedPixelsKeepTheirBytesWhateverTheMethod) {
  RgbImage picture(kCamera.width, kCamera.height, 3);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture.data()[i] = static_cast<std::uint8_t>(random());
  }
  // The board reaches 47 pixels from the center.
  for (const AntialiasingMethod method : kAntialiasingMethods) {
    const RgbImage image = Compose({WhiteBoard()}, picture, kCamera, kSunLux, Using(method, 4));
    int equal = 0;
    for (int y = 0; y < kCamera.height; ++y) {
      for (int x = 0; x < kCamera.width; ++x) {
        if (std::hypot(x - kCamera.cx, y - kCamera.cy) < 52) continue;
        for (int c = 0; c < 3; ++c) ASSERT_EQ(image(x, y, c), picture(x, y, c)) << NameOf(method);
        ++equal;
      }
    }
    EXPECT_GT(equal, 60000);
  }
}

TEST(ComposerAntialiasing, AllMethodsAgreeAwayFromEdges) {
  const RgbImage picture = EvenPicture(120);
  const auto draw = [&](AntialiasingMethod method) {
    return Compose({kGround, kCube}, picture, kCamera, kSunLux, Using(method, 8), {}, false);
  };
  const RgbImage samples = draw(AntialiasingMethod::kMultisample);
  for (const AntialiasingMethod method :
       {AntialiasingMethod::kSubpixel, AntialiasingMethod::kNone, AntialiasingMethod::kReference}) {
    const RgbImage image = draw(method);
    // The cube's top, its shadow to the north, and the open ground.
    for (const Vec3 point : {Vec3{0, 0, 0.3}, Vec3{0, 0.3, 0}, Vec3{0.5, -0.3, 0}}) {
      EXPECT_NEAR(SeenAt(image, point), SeenAt(samples, point), 0.004) << NameOf(method);
    }
  }
}

TEST(ComposerAntialiasing, AnImageOfOnePixelIsTheMeanOfItsPlaces) {
  CameraModel camera = kCamera;
  camera.width = camera.height = 1;
  camera.fx = camera.fy = 4;
  camera.cx = camera.cy = 0;
  RgbImage black(1, 1, 3);
  std::fill_n(black.data(), black.size(), std::uint8_t{0});
  for (const AntialiasingMethod method : kAntialiasingMethods) {
    const RgbImage image = Compose({WhiteBoard(0.0)}, black, camera, kSunLux, Using(method));
    const double covered = LinearFromSrgb8()[image(0, 0, 0)];
    if (method == AntialiasingMethod::kReference || method == AntialiasingMethod::kSubpixel) {
      // The board is wider than the pixel, and 2/3 of it high.
      const auto places = SamplePlaces(64);
      const auto on_board = std::count_if(places.begin(), places.end(), [](glm::vec2 place) {
        return std::abs(place.y) < 1.0F / 3;
      });
      EXPECT_NEAR(covered, static_cast<double>(on_board) / 64, 0.004);
    } else {
      EXPECT_GE(covered, method == AntialiasingMethod::kNone ? 1.0 : 0.5);
    }
  }
}

}  // namespace
}  // namespace pleinair::compositor
