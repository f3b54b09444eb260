// Antialiasing of composed edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>

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

TEST(ComposerAntialiasing, TheReferenceHasTheAreaOfABoardAndEdgesOfManyLevels) {
  const RgbImage image = Compose({WhiteBoard()}, EvenPicture(0), kCamera, kSunLux,
                                 Using(AntialiasingMethod::kReference));
  EXPECT_NEAR(TotalLight(image) / kBoard_px2, 1.0, 5e-4);
  std::array<bool, 256> seen{};
  for (std::size_t i = 0; i < image.size(); i += 3) seen[image.data()[i]] = true;
  EXPECT_GT(std::count(seen.begin(), seen.end(), true), 30);
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
       {AntialiasingMethod::kNone, AntialiasingMethod::kReference}) {
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
    if (method == AntialiasingMethod::kReference) {
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
