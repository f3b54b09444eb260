#include "tracker/quads/quad_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/tracker/quads/quad_test_markers.h"

namespace pleinair::tracker {
namespace {

std::vector<Quad> Detect(const GreyImage& image) {
  QuadDetector detector;
  std::vector<Quad> quads;
  detector.Detect(image.view(), &quads);
  return quads;
}

/// Corner error of a single marker, RMS in pixels.
double ErrorOf(const CameraModel& camera, const RenderedMarker& print,
               const RenderingOptions& options) {
  return NearestError(Detect(RenderMarkers(camera, {print}, options)), TrueCorners(camera, print));
}

TEST(QuadDetector, FindsPrintsFromTwoHundredToFifteenPixels) {
  const CameraModel camera = Pinhole(320, 310);
  for (const double side : {200.0, 130.0, 70.0, 40.0, 28.0, 22.0, 18.0, 16.0, 15.0}) {
    for (const double roll : {0.0, 17.0, 45.0}) {
      const RenderedMarker print =
          MarkerAt(camera, static_cast<unsigned>(side + roll), {161.3, 152.8}, side, 10, 30, roll);
      EXPECT_LT(ErrorOf(camera, print, {.blur_px = 0.55, .light = {}}), 1.0)
          << side << " px, turned by " << roll;
    }
  }
}

TEST(QuadDetector, FindsPrintsTiltedToEightyTwoDegrees) {
  const CameraModel camera = Pinhole(220, 220);
  for (const double tilt : {30.0, 60.0, 70.0, 78.0, 80.0, 82.0}) {
    for (const double axis : {0.0, 50.0}) {
      const RenderedMarker print = MarkerAt(camera, 5, {109.0, 111.0}, 130, tilt, axis, 15);
      EXPECT_LT(ErrorOf(camera, print, {.blur_px = 0.55, .light = {}}), 2.0)
          << tilt << " degrees about " << axis;
    }
  }
}

TEST(QuadDetector, FindsPrintsInNoise) {
  const CameraModel camera = Pinhole(160, 160);
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    const RenderedMarker print = MarkerAt(camera, seed, {80.0, 81.0}, 80, 20, 70, 9.0 * seed);
    EXPECT_LT(ErrorOf(camera, print, {.noise_codes = 25.0, .seed = seed, .light = {}}), 2.0)
        << "seed " << seed;
  }
}

TEST(QuadDetector, FindsPrintsInTheDark) {
  const CameraModel camera = Pinhole(160, 160);
  RenderedMarker print = MarkerAt(camera, 8, {80.0, 80.0}, 80, 20, 70, 30);
  print.black = 0.0012;  // Pixel value 4.
  print.white = 0.0212;  // Pixel value 40.
  for (const unsigned seed : {1U, 2U, 3U}) {
    EXPECT_LT(ErrorOf(camera, print,
                      {.background = 0.006, .noise_codes = 2.0, .seed = seed, .light = {}}),
              1.0);
  }
}

TEST(QuadDetector, FindsPrintsOutOfFocus) {
  const CameraModel camera = Pinhole(180, 180);
  const RenderedMarker print = MarkerAt(camera, 3, {91.0, 88.0}, 100, 15, 120, 25);
  // A disk of 2.5 px radius has the same spread as a Gaussian with half of that as σ.
  EXPECT_LT(ErrorOf(camera, print, {.blur_px = 1.25, .light = {}}), 0.5);
  EXPECT_LT(ErrorOf(camera, print, {.blur_px = 2.5, .light = {}}), 1.0);
}

TEST(QuadDetector, FindsPrintsMovedDuringTheExposure) {
  const CameraModel camera = Pinhole(180, 180);
  const RenderedMarker print = MarkerAt(camera, 3, {91.0, 88.0}, 100, 15, 120, 25);
  const GreyImage sharp = RenderMarkers(camera, {print}, {.blur_px = 0.55, .light = {}});
  constexpr int kReach = 3;  // 7 px along the rows.
  GreyImage moved = sharp;
  for (int y = 0; y < sharp.height(); ++y) {
    for (int x = kReach; x < sharp.width() - kReach; ++x) {
      int sum = 0;
      for (int i = -kReach; i <= kReach; ++i) sum += sharp(x + i, y);
      moved(x, y) = static_cast<std::uint8_t>(sum / (2 * kReach + 1));
    }
  }
  EXPECT_LT(NearestError(Detect(moved), TrueCorners(camera, print)), 2.0);
}

TEST(QuadDetector, FindsPrintsWhereLightFallsTenToOne) {
  const CameraModel camera = Pinhole(200, 200);
  const RenderedMarker print = MarkerAt(camera, 11, {100.0, 100.0}, 110, 15, 120, 25);
  for (const double direction : {0.0, 1.0, 2.5}) {
    const auto light = [direction](Vec2 pixel) {
      const double along =
          (pixel.x - 100.0) * std::cos(direction) + (pixel.y - 100.0) * std::sin(direction);
      return std::pow(10.0, -0.5 + along / 110.0) * 0.3;
    };
    EXPECT_LT(ErrorOf(camera, print, {.noise_codes = 2.0, .light = light}), 1.5) << direction;
  }
}

TEST(QuadDetector, FindsPrintsCrossedByTheEdgeOfAShadow) {
  const CameraModel camera = Pinhole(200, 200);
  const RenderedMarker print = MarkerAt(camera, 11, {100.0, 100.0}, 110, 15, 120, 25);
  for (const double ratio : {2.0, 4.0, 8.0, 12.0}) {
    for (const double direction : {0.3, 2.0, 4.0}) {
      const auto light = [=](Vec2 pixel) {
        const double along =
            (pixel.x - 90.0) * std::cos(direction) + (pixel.y - 105.0) * std::sin(direction);
        return along > 0.0 ? 1.0 : 1.0 / ratio;
      };
      EXPECT_LT(ErrorOf(camera, print, {.blur_px = 0.55, .noise_codes = 2.0, .light = light}), 2.0)
          << ratio << ":1 at " << direction;
    }
  }
}

TEST(QuadDetector, FindsFiftyPrintsAtOnceAndLittleElse) {
  const CameraModel camera = Pinhole(480, 300);
  std::vector<RenderedMarker> prints;
  for (int i = 0; i < 50; ++i) {
    const Vec2 centre{24.0 + 48.0 * (i % 10), 30.0 + 60.0 * (i / 10.0 - i % 10 / 10.0)};
    prints.push_back(MarkerAt(camera, i, centre, 28.0, 1.0 * (i % 5) * 8, 7.0 * i, 13.0 * i));
  }
  const std::vector<Quad> quads =
      Detect(RenderMarkers(camera, prints, {.blur_px = 0.55, .noise_codes = 2.0, .light = {}}));
  for (const RenderedMarker& print : prints) {
    EXPECT_LT(NearestError(quads, TrueCorners(camera, print)), 1.0);
  }
  EXPECT_LE(quads.size(), prints.size() + 5);  // Dark shapes within the prints.
}

TEST(QuadDetector, FindsPrintsWhoseQuietZoneLiesInClutter) {
  const CameraModel camera = Pinhole(160, 160);
  // Checks in the marker's black and white, as wide as its rim, up to the quiet zone.
  const RenderedMarker print = MarkerAt(camera, 21, {80.0, 80.0}, 60, 20, 40, 33);
  RenderedMarker checks = MarkerAt(camera, 0, {80.0, 80.0}, 150, 0, 0, 0);
  auto pattern = std::make_shared<MarkerPattern>();
  pattern->modules = pattern->edge_modules = 24;
  for (int i = 0; i < 24 * 24; ++i) pattern->white.push_back((i % 24 + i / 24) % 2);
  checks.pattern = pattern;
  const GreyImage image =
      RenderMarkers(camera, {checks, print}, {.blur_px = 0.55, .noise_codes = 3.0, .light = {}});
  EXPECT_LT(NearestError(Detect(image), TrueCorners(camera, print)), 0.5);
  // On a black background.
  EXPECT_LT(ErrorOf(camera, print, {.background = 0.04, .blur_px = 0.55, .light = {}}), 0.5);
}

TEST(QuadDetector, GivesCornersClockwiseAndTheContrastOfTheRim) {
  const CameraModel camera = Pinhole(160, 160);
  const RenderedMarker print = MarkerAt(camera, 2, {80.0, 80.0}, 90, 0, 0, 0);
  const std::vector<Quad> quads = Detect(RenderMarkers(camera, {print}, {.light = {}}));
  ASSERT_EQ(quads.size(), 1U);
  const std::array<Vec2, 4>& corners = quads[0].corners_px;
  for (int i = 0; i < 4; ++i) {
    const Vec2 before = corners[(i + 1) % 4] - corners[i];
    const Vec2 after = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    EXPECT_GT(before.x * after.y - before.y * after.x, 0.0);
  }
  // White 0.8 has the pixel value 231, black 0.04 has 56.
  EXPECT_NEAR(quads[0].contrast, 175.0, 2.0);
}

TEST(QuadDetector, FindsNothingThatIsNoDarkQuadrilateral) {
  GreyImage image(120, 120);
  const auto draw = [&](auto dark) {
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 120; ++x) image(x, y) = dark(x - 60, y - 60) ? 30 : 220;
    }
    return Detect(image).size();
  };
  EXPECT_EQ(draw([](int x, int y) { return std::abs(x) < 30 && std::abs(y) < 30; }), 1U);
  EXPECT_EQ(draw([](int x, int y) { return x * x + y * y < 900; }), 0U) << "disk";
  EXPECT_EQ(draw([](int x, int y) { return y < 30 && y > 2 * std::abs(x) - 40; }), 0U)
      << "triangle";
  EXPECT_EQ(draw([](int x, int y) { return std::abs(x) >= 30 || std::abs(y) >= 30; }), 0U)
      << "white square";
  EXPECT_EQ(draw([](int x, int y) { return std::abs(x) < 30 && std::abs(y) < 3; }), 0U) << "bar";
}

TEST(QuadDetector, FindsNothingInPicturesOfOneValueAndLittleInNoise) {
  for (const int value : {0, 128, 255}) {
    GreyImage image(640, 480);
    std::fill_n(image.data(), image.size(), static_cast<std::uint8_t>(value));
    EXPECT_TRUE(Detect(image).empty());
  }
  GreyImage noise(640, 480);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    noise.data()[i] = static_cast<std::uint8_t>(random());
  }
  EXPECT_LE(Detect(noise).size(), 2U);
}

TEST(QuadDetector, TakesPicturesOfAnySize) {
  std::mt19937 random(3);
  for (const int width : {0, 1, 3, 7, 8, 9, 63, 64, 65}) {
    for (const int height : {0, 1, 5, 8, 17, 200}) {
      GreyImage image(width, height);
      for (std::size_t i = 0; i < image.size(); ++i) {
        image.data()[i] = static_cast<std::uint8_t>(random() % 2 * 255);
      }
      for (const Quad& quad : Detect(image)) {
        for (const Vec2 corner : quad.corners_px) {
          EXPECT_TRUE(corner.x > -1 && corner.x < width && corner.y > -1 && corner.y < height);
        }
      }
    }
  }
}

TEST(QuadDetector, FindsAMarkerInAnEightThousandPixelImage) {
  const CameraModel camera = Pinhole(160, 160);
  const RenderedMarker print = MarkerAt(camera, 2, {80.0, 80.0}, 90, 30, 20, 10);
  const GreyImage small = RenderMarkers(camera, {print}, {.light = {}});
  GreyImage image(7680, 4320);
  std::fill_n(image.data(), image.size(), small(0, 0));
  constexpr int kLeft = 7301, kTop = 4003;
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 160; ++x) image(kLeft + x, kTop + y) = small(x, y);
  }
  std::array<Vec2, 4> truth = TrueCorners(camera, print);
  for (Vec2& corner : truth) corner = corner + Vec2{kLeft, kTop};
  EXPECT_LT(NearestError(Detect(image), truth), 0.5);
}

TEST(QuadDetector, SeesThroughAStrideWhatItSeesInAWholePicture) {
  const CameraModel camera = Pinhole(163, 161);
  const GreyImage image = RenderMarkers(camera, {MarkerAt(camera, 2, {80, 80}, 90, 30, 20, 10)},
                                        {.noise_codes = 4.0, .light = {}});
  GreyImage wide(300, 161);
  for (std::size_t i = 0; i < wide.size(); ++i) wide.data()[i] = static_cast<std::uint8_t>(i * 97);
  for (int y = 0; y < 161; ++y) {
    for (int x = 0; x < 163; ++x) wide(70 + x, y) = image(x, y);
  }
  QuadDetector detector;
  std::vector<Quad> quads;
  detector.Detect({wide.data() + 70, 163, 161, 1, 300}, &quads);
  const std::vector<Quad> whole = Detect(image);
  ASSERT_GE(whole.size(), 1U);
  ASSERT_EQ(quads.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(quads[i].corners_px, whole[i].corners_px);
    EXPECT_EQ(quads[i].contrast, whole[i].contrast);
  }
}

TEST(QuadDetector, GivesTheSameQuadsWhateverItSawBefore) {
  const CameraModel camera = Pinhole(200, 200);
  const GreyImage image = RenderMarkers(camera, {MarkerAt(camera, 2, {80, 80}, 90, 30, 20, 10)},
                                        {.noise_codes = 9.0, .light = {}});
  QuadDetector detector;
  std::vector<Quad> quads;
  GreyImage other(331, 97);
  for (std::size_t i = 0; i < other.size(); ++i) {
    other.data()[i] = static_cast<std::uint8_t>(i * i / 7);
  }
  detector.Detect(other.view(), &quads);
  detector.Detect(image.view(), &quads);
  const std::vector<Quad> fresh = Detect(image);
  ASSERT_EQ(quads.size(), fresh.size());
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    EXPECT_EQ(quads[i].corners_px, fresh[i].corners_px);
  }
}

}  // namespace
}  // namespace pleinair::tracker
