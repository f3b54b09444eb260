#include "tracker/surf_golay/orientation_test.h"

#include <algorithm>
#include <cmath>

#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr int kBandFirst = 2, kBandLast = 9;  ///< First and last ring of modules that are sampled.

/// Position of a module after `k` quarter turns of the marker clockwise; from 4 on, the marker is
/// mirrored first.
std::array<int, 2> Turned(int column, int row, int k) {
  if (k >= 4) column = sg::kEdge - 1 - column;
  for (int i = 0; i < k % 4; ++i) {
    const int before = column;
    column = sg::kEdge - 1 - row;
    row = before;
  }
  return {column, row};
}

}  // namespace

OrientationTest::OrientationTest() {
  std::vector<int> index(static_cast<std::size_t>(sg::kEdge) * sg::kEdge, -1);
  std::vector<std::array<int, 2>> modules;
  std::vector<float> white;
  for (int row = 0; row < sg::kEdge; ++row) {
    for (int column = 0; column < sg::kEdge; ++column) {
      const int ring = std::min({column, row, sg::kEdge - 1 - column, sg::kEdge - 1 - row});
      if (ring < kBandFirst || ring > kBandLast) continue;
      index[row * sg::kEdge + column] = static_cast<int>(modules.size());
      modules.push_back({column, row});
      white.push_back(sg::kBorder[row][column] == '.' ? 1.0F : 0.0F);
      u_.push_back(2.0F * (static_cast<float>(column) + 0.5F) / sg::kEdge - 1.0F);
      v_.push_back(1.0F - 2.0F * (static_cast<float>(row) + 0.5F) / sg::kEdge);
    }
  }
  float mean = 0.0F, length = 0.0F;
  for (const float value : white) mean += value / static_cast<float>(white.size());
  for (float& value : white) {
    value -= mean;
    length += value * value;
  }
  expected_.resize(modules.size());
  for (std::size_t i = 0; i < modules.size(); ++i) {
    for (int k = 0; k < kOrientations; ++k) {
      const auto turned = Turned(modules[i][0], modules[i][1], k);
      expected_[index[turned[1] * sg::kEdge + turned[0]]][k] = white[i] / std::sqrt(length);
    }
  }
  x_.resize(modules.size());
  y_.resize(modules.size());
}

std::array<BorderOrientation, 2> OrientationTest::Evaluate(ImageView<const std::uint8_t> grey,
                                                           const std::array<Vec2, 4>& corners_px) {
  const Mat3 homography = HomographyToQuad(corners_px);
  std::array<float, 9> h{};
  for (int i = 0; i < 9; ++i) h[i] = static_cast<float>(homography.m[i]);
  const float right = static_cast<float>(grey.width() - 1);
  const float bottom = static_cast<float>(grey.height() - 1);
  const std::size_t count = expected_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float w = 1.0F / (h[6] * u_[i] + h[7] * v_[i] + h[8]);
    const float x = (h[0] * u_[i] + h[1] * v_[i] + h[2]) * w + 0.5F;
    const float y = (h[3] * u_[i] + h[4] * v_[i] + h[5]) * w + 0.5F;
    // This order of the operands turns NaN into 0 too.
    x_[i] = static_cast<std::int32_t>(std::min(right, std::max(0.0F, x)));
    y_[i] = static_cast<std::int32_t>(std::min(bottom, std::max(0.0F, y)));
  }
  float sum = 0.0F, squares = 0.0F;
  std::array<float, kOrientations> products{};
  for (std::size_t i = 0; i < count; ++i) {
    const float value = grey(x_[i], y_[i]);
    sum += value;
    squares += value * value;
    for (int k = 0; k < kOrientations; ++k) products[k] += expected_[i][k] * value;
  }
  const float n = static_cast<float>(count);
  const float spread = std::sqrt(std::max(1e-3F, squares - sum * sum / n));
  std::array<BorderOrientation, 2> best{};
  best[0].correlation = best[1].correlation = -2.0;
  for (int k = 0; k < kOrientations; ++k) {
    BorderOrientation here;
    here.correlation = products[k] / spread;
    here.mirrored = k >= 4;
    // After k clockwise turns the marker's top-left corner lies at the quadrilateral's corner k. A
    // mirrored one begins at the next corner.
    here.first_corner = k < 4 ? k : (k + 1) % 4;
    if (here.correlation > best[0].correlation) {
      best[1] = best[0];
      best[0] = here;
    } else if (here.correlation > best[1].correlation) {
      best[1] = here;
    }
  }
  return best;
}

}  // namespace pleinair::tracker
