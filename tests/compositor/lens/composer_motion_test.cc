// Motion blur of composed images against rays from a moving camera.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "tests/compositor/lens/board_scene.h"

namespace pleinair::compositor {
namespace {

constexpr int kRays = 1024;

/// Sideways by so many metres during the exposure.
CameraMotion Sideways(double metres) {
  return [metres](double share) {
    Transform<Camera, Marker> pose = kFromAbove;
    pose.translation_m.x += share * metres;
    return pose;
  };
}

/// Linear light at a pixel of a camera that moves sideways: each ray has its own time and place.
/// `boards`: from near to far.
double TracedMoving(const std::vector<Board>& boards, double background, double metres, int x,
                    int y, bool with_virtual) {
  double sum = 0.0;
  for (int i = 0; i < kRays; ++i) {
    const double time = (i + 0.5) / kRays - 0.5;
    const double dx = std::fmod(i * 0.7548776662466927, 1.0) - 0.5;
    const double dy = std::fmod(i * 0.5698402909980532, 1.0) - 0.5;
    double seen = background;
    for (const Board& board : boards) {
      if (!with_virtual && !board.is_real) continue;
      const double z = board.distance_m;
      const double at_x = z * (x + dx - kSmall.cx) / kSmall.fx - time * metres;
      const double at_y = z * (y + dy - kSmall.cy) / kSmall.fy;
      if (!board.Covers(at_x, -at_y)) continue;
      seen = board.light;
      break;
    }
    sum += seen;
  }
  return sum / kRays;
}

Drawing Moving(double metres) {
  return {.places = kByLayers, .options = {}, .motion = Sideways(metres)};
}

TEST(ComposerMotion, CoversObjectsSoftlyByMovingRealOccluders) {
  std::vector<Board> boards;
  for (int i = 0; i < 3; ++i) {  // 15 pixels wide, with streaks of 9 pixels.
    const double x = -0.14 + 0.09 * i;
    boards.push_back({x, -0.3, x + 0.05, 0.3, 1.0, 0.1F, true});
  }
  boards.push_back({-0.2, -0.5, 0.12, 0.12, 2.0, 0.8F});
  constexpr double kBackground = 0.3, kMoved_m = 0.03;
  RgbImage frame = Even(kSmall, 0), truth = frame;
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      const double real = TracedMoving(boards, kBackground, kMoved_m, x, y, false);
      const double mixed = TracedMoving(boards, kBackground, kMoved_m, x, y, true);
      for (int c = 0; c < 3; ++c) {
        frame(x, y, c) = Srgb8FromLinear(static_cast<float>(real));
        truth(x, y, c) = Srgb8FromLinear(static_cast<float>(mixed));
      }
    }
  }
  LensFigures figures;
  const RgbImage image =
      ComposeThrough(boards, frame, kSmall, {}, Moving(kMoved_m), nullptr, &figures);
  EXPECT_NEAR(figures.longest_streak_px, 9.0, 0.1);
  EXPECT_EQ(figures.views, 9);
  double squares = 0.0;
  int worst = 0;
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      const double off = LinearFromSrgb8()[image(x, y, 1)] - LinearFromSrgb8()[truth(x, y, 1)];
      squares += off * off;
      worst = std::max(worst, std::abs(image(x, y, 1) - truth(x, y, 1)));
    }
  }
  // Nearly all of this small image lies near edges. The contrast is 0.7.
  EXPECT_LT(std::sqrt(squares / (kSmall.width * kSmall.height)), 0.015 * 0.7);
  EXPECT_LE(worst, 16);
}

TEST(ComposerMotion, KeepsTheBytesOfWhatItDoesNotTouch) {
  const std::vector<Board> boards{{-0.1, -0.1, 0.13, 0.12, 2.0, 0.7F}};
  RgbImage frame = Even(kSmall, 90);
  for (int x = 0; x < kSmall.width; ++x) frame(x, 3, 1) = static_cast<std::uint8_t>(x);
  const Drawing still{kByLayers, {}, {}};
  const RgbImage off = ComposeThrough(boards, frame, kSmall, {}, still);
  // By 0.2 pixels: the same bytes.
  const RgbImage slow = ComposeThrough(boards, frame, kSmall, {}, Moving(0.2 * 2.0 / kSmall.fx));
  EXPECT_TRUE(std::equal(off.data(), off.data() + off.size(), slow.data()));
  const RgbImage moved = ComposeThrough(boards, frame, kSmall, {}, Moving(8.0 * 2.0 / kSmall.fx));
  int changed = 0, touched = 0;
  for (int y = 0; y < kSmall.height; ++y) {
    for (int x = 0; x < kSmall.width; ++x) {
      const bool is_same = std::equal(&moved(x, y, 0), &moved(x, y, 0) + 3, &frame(x, y, 0));
      touched += is_same ? 0 : 1;
      changed += moved(x, y, 1) != off(x, y, 1) ? 1 : 0;
      // The board from −15 to 20, with half a streak and the interpolation around it.
      if (x < 63 - 15 - 4 - 2 || x > 63 + 20 + 4 + 2) {
        EXPECT_TRUE(is_same) << x << ", " << y;
      }
    }
  }
  EXPECT_GT(changed, 200);
  EXPECT_GT(touched, 1000);
}

}  // namespace
}  // namespace pleinair::compositor
