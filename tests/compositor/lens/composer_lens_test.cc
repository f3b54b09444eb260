// Depth of field of composed images against analytic edges and a ray-traced thin lens.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "tests/compositor/lens/board_scene.h"

namespace pleinair::compositor {
namespace {

/// Linear light at a pixel, traced through 32 x 32 strata of the stop, each at its own place of the
/// pixel. `boards`: from near to far.
double Traced(const std::vector<Board>& boards, double background, const CameraModel& camera,
              const ThinLens& lens, int x, int y, bool with_virtual = true) {
  double sum = 0.0;
  for (int i = 0; i < 1024; ++i) {
    const int ring = i % 32, ray = i / 32;
    const double r = std::sqrt((ring + 0.5) / 32.0) * lens.aperture_m / 2;
    const double angle = 2 * std::numbers::pi * (ray + 0.5) / 32.0;
    const double u = r * std::cos(angle), v = r * std::sin(angle);
    const double dx = std::fmod(i * 0.7548776662466927, 1.0) - 0.5;
    const double dy = std::fmod(i * 0.5698402909980532, 1.0) - 0.5;
    double seen = background;
    for (const Board& board : boards) {
      if (!with_virtual && !board.is_real) continue;
      const double z = board.distance_m, moved = 1.0 - z * lens.focus_dioptres;
      const double at_x = z * (x + dx - camera.cx) / camera.fx + u * moved;
      const double at_y = z * (y + dy - camera.cy) / camera.fy + v * moved;
      if (!board.Covers(at_x, -at_y)) continue;
      seen = board.light;
      break;
    }
    sum += seen;
  }
  return sum / 1024;
}

Drawing Through(int places, int pixel_places = 0) {
  Drawing drawing{places, {}};
  if (pixel_places > 0) {
    drawing.options.antialiasing = {AntialiasingMethod::kReference, pixel_places};
  }
  return drawing;
}

TEST(ComposerLens, DrawsTheEdgeOfADisc) {
  // Its right edge runs through the image's centre.
  const Board board{-2, -2, 0, 2, 2.0, 1.0F};
  for (const auto& [circle_px, places] : std::vector<std::pair<double, int>>{{2.0, 96},
                                                                             {8.0, 96},
                                                                             {40.0, 96},
                                                                             {2.0, kByLayers},
                                                                             {3.3, kByLayers},
                                                                             {8.0, kByLayers},
                                                                             {40.0, kByLayers}}) {
    const double focus_dioptres = 1.0, aperture_m = circle_px / (kSmall.fx * 0.5);
    double largest_px = 0.0;
    const RgbImage image =
        ComposeThrough({board}, Even(kSmall, 0), kSmall, ThinLens{aperture_m, focus_dioptres},
                       Through(places), &largest_px);
    EXPECT_NEAR(largest_px, circle_px, 1e-3 * circle_px);
    double squares = 0.0;
    int count = 0;
    for (int x = 0; x < kSmall.width; ++x) {
      // The mean over the pixel's width.
      double expected = 0.0;
      for (int i = 0; i < 64; ++i) {
        const double at = x - kSmall.cx + (i + 0.5) / 64 - 0.5;
        const double u = std::clamp(-2.0 * at / circle_px, -1.0, 1.0);
        expected += (0.5 + (u * std::sqrt(1 - u * u) + std::asin(u)) / std::numbers::pi) / 64;
      }
      const double error = LinearFromSrgb8()[image(x, 48, 0)] - expected;
      if (std::fabs(x - kSmall.cx) > 0.5 * circle_px + 1) {
        EXPECT_NEAR(error, 0.0, 0.004) << x;
        continue;
      }
      squares += error * error;
      ++count;
    }
    EXPECT_LT(std::sqrt(squares / count), places == kByLayers ? 0.003 : 0.008) << circle_px;
  }
}

TEST(ComposerLens, EqualsTheTracedLensWhereBoardsCross) {
  // Circles of 8, 3.5 and 0 pixels.
  const ThinLens lens{0.05, 0.4};
  const auto at = [](double circle_px) { return 1.0 / (0.4 + circle_px / 15.0); };
  const std::vector<Board> boards{{-0.30, -0.05, -0.02, 0.10, at(8), 0.8F},
                                  {-0.12, -0.20, 0.05, 0.03, at(3.5), 0.3F},
                                  {-0.20, -0.10, 0.25, 0.25, at(0), 0.6F}};
  for (const int places : {64, kByLayers}) {
    const RgbImage image =
        ComposeThrough(boards, Even(kSmall, 0), kSmall, lens, Through(places, 16));
    double squares = 0.0;
    int count = 0, far_off = 0;
    for (int y = 0; y < kSmall.height; ++y) {
      for (int x = 0; x < kSmall.width; ++x) {
        const double truth = Traced(boards, 0.0, kSmall, lens, x, y);
        const double error = LinearFromSrgb8()[image(x, y, 0)] - truth;
        squares += error * error;
        far_off += std::fabs(error) > 0.05 ? 1 : 0;
        ++count;
      }
    }
    // All of this small image lies near silhouettes. The contrast is 0.8.
    EXPECT_LT(std::sqrt(squares / count) / 0.8, places == kByLayers ? 0.007 : 0.003);
    EXPECT_LT(far_off, 0.005 * count);
  }
}

// What objects hide of one another is drawn. A board's rim goes on behind the bars, and the far
// side of a deep body covers what is behind it.
TEST(ComposerLens, SeesPastTheEdgesOfObjects) {
  const ThinLens lens{0.05, 0.4};
  const auto at = [](double circle_px) { return 1.0 / (0.4 + circle_px / 15.0); };
  std::vector<Board> boards;
  for (int i = 0; i < 4; ++i) {
    const double left = -0.17 + 0.08 * i;
    boards.push_back({left, -0.2, left + 0.03, 0.2, at(8), 0.15F});
  }
  boards.push_back({-0.22, -0.15, 0.3, 0.14, at(0), 0.9F});
  LensFigures figures;
  const RgbImage image = ComposeThrough(boards, Even(kSmall, 0), kSmall, lens,
                                        {.places = kByLayers, .options = {}}, nullptr, &figures);
  EXPECT_EQ(figures.peels, 1);
  double squares = 0.0, worst = 0.0;
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      const double error =
          LinearFromSrgb8()[image(x, y, 0)] - Traced(boards, 0.0, kSmall, lens, x, y);
      squares += error * error;
      worst = std::max(worst, std::fabs(error));
    }
  }
  EXPECT_LT(std::sqrt(squares / (kSmall.width * kSmall.height)) / 0.9, 0.008);
  EXPECT_LT(worst, 0.1);
}

TEST(ComposerLens, CoversObjectsSoftlyByBlurredRealOccluders) {
  const ThinLens lens{0.04, 0.5};  // In focus at 2 m.
  std::vector<Board> boards;
  for (int i = 0; i < 4; ++i) {  // 12 pixels wide, with a circle of 12 pixels.
    const double x = -0.10 + 0.055 * i;
    boards.push_back({x, -0.3, x + 0.0267, 0.3, 1.0 / 1.5, 0.1F, true});
  }
  boards.push_back({-0.2, -0.5, 0.11, 0.12, 2.0, 0.8F});
  constexpr double kBackground = 0.3;
  RgbImage frame = Even(kSmall, 0), truth = frame;
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      const double real = Traced(boards, kBackground, kSmall, lens, x, y, false);
      const double mixed = Traced(boards, kBackground, kSmall, lens, x, y);
      for (int c = 0; c < 3; ++c) {
        frame(x, y, c) = Srgb8FromLinear(static_cast<float>(real));
        truth(x, y, c) = Srgb8FromLinear(static_cast<float>(mixed));
      }
    }
  }
  for (const int places : {64, kByLayers}) {
    const RgbImage image = ComposeThrough(boards, frame, kSmall, lens, Through(places));
    double squares = 0.0;
    int worst = 0, count = 0;
    for (int y = 0; y < kSmall.height; ++y) {
      for (int x = 0; x < kSmall.width; ++x) {
        // Off the board's own sharp edges, which antialiasing decides.
        const double board_x = 2.0 * (x - kSmall.cx) / kSmall.fx;
        const double board_y = -2.0 * (y - kSmall.cy) / kSmall.fy;
        if (std::fabs(board_x - 0.11) < 0.01 || std::fabs(board_y - 0.12) < 0.01) continue;
        const int error = image(x, y, 1) - truth(x, y, 1);
        squares += error * error;
        worst = std::max(worst, std::abs(error));
        ++count;
      }
    }
    EXPECT_LT(std::sqrt(squares / count), places == kByLayers ? 2.0 : 1.0);
    EXPECT_LE(worst, places == kByLayers ? 8 : 4);
  }
}

TEST(ComposerLens, LeavesWhatIsInFocusAsItIs) {
  const std::vector<Board> boards{{-0.1, -0.1, 0.13, 0.12, 2.0, 0.7F}};
  const RgbImage off = ComposeThrough(boards, Even(kSmall, 90), kSmall, {}, Through(32));
  // Circles below 0.3 pixels: the same bytes.
  const RgbImage tiny =
      ComposeThrough(boards, Even(kSmall, 90), kSmall, ThinLens{0.0018, 1.0}, Through(32));
  EXPECT_TRUE(std::equal(off.data(), off.data() + off.size(), tiny.data()));
  // Another board, out of focus and beside it, makes the lens be drawn.
  std::vector<Board> both = boards;
  both.push_back({0.16, -0.1, 0.25, 0.1, 1.5, 0.2F});
  double largest_px = 0.0;
  for (const int places : {32, kByLayers}) {
    const RgbImage drawn = ComposeThrough(both, Even(kSmall, 90), kSmall, ThinLens{0.02, 0.5},
                                          Through(places), &largest_px);
    EXPECT_GT(largest_px, 0.9);
    for (int y = 0; y < kSmall.height; ++y) {
      for (int x = 0; x < 90; ++x) EXPECT_NEAR(drawn(x, y, 0), off(x, y, 0), 1);
    }
  }
}

TEST(ComposerLens, DrawsTheStopsShape) {
  // A small bright board far out of focus has the shape of the stop, mirrored before the focus.
  const std::vector<Board> boards{{-0.004, -0.004, 0.004, 0.004, 1.0, 1.0F}};
  for (const int places : {512, kByLayers}) {
    const RgbImage image = ComposeThrough(boards, Even(kSmall, 0), kSmall,
                                          ThinLens{0.2, 0.5, {3, 0.0}}, Through(places));
    // A circle of 30 pixels: its corner is 15 from the centre, the side opposite 7.5.
    const auto reach = [&](int step) {
      int last = 0;
      for (int i = 0; i < 60; ++i) {
        if (image(64 + step * i, 48, 0) > 10) last = i;
      }
      return last;
    };
    EXPECT_NEAR(reach(-1), 15, 2);
    EXPECT_NEAR(reach(1), 8, 2);
  }
}

}  // namespace
}  // namespace pleinair::compositor
