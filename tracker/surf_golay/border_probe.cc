#include "tracker/surf_golay/border_probe.h"

#include <algorithm>
#include <cmath>

#include "tracker/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

constexpr int kBandFirst = 2, kBandLast = 9;  ///< Rings of modules that are looked at.

/// Place of a module when the print is turned clockwise `k` times a quarter, mirrored before from 4
/// on.
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

BorderProbe::BorderProbe() {
  std::vector<int> index(static_cast<std::size_t>(sg::kEdge) * sg::kEdge, -1);
  std::vector<std::array<int, 2>> modules;
  for (int row = 0; row < sg::kEdge; ++row) {
    for (int column = 0; column < sg::kEdge; ++column) {
      const int ring = std::min({column, row, sg::kEdge - 1 - column, sg::kEdge - 1 - row});
      if (ring < kBandFirst || ring > kBandLast) continue;
      index[row * sg::kEdge + column] = static_cast<int>(modules.size());
      modules.push_back({column, row});
      ideal_.push_back(sg::kBorder[row][column] == '.' ? 1.0F : 0.0F);
    }
  }
  for (const auto& [column, row] : modules) {
    Point point;
    point.column = (static_cast<float>(column) + 0.5F) / sg::kEdge;
    point.row = (static_cast<float>(row) + 0.5F) / sg::kEdge;
    for (int k = 0; k < 8; ++k) {
      const auto turned = Turned(column, row, k);
      point.at[k] = static_cast<std::int16_t>(index[turned[1] * sg::kEdge + turned[0]]);
    }
    points_.push_back(point);
  }
  float mean = 0.0F, length = 0.0F;
  for (const float value : ideal_) mean += value / static_cast<float>(ideal_.size());
  for (float& value : ideal_) {
    value -= mean;
    length += value * value;
  }
  for (float& value : ideal_) value /= std::sqrt(length);
  seen_.resize(points_.size());
}

std::array<ProbedOrientation, 2> BorderProbe::Look(ImageView<const std::uint8_t> grey,
                                                   const std::array<Vec2, 4>& corners_px) {
  const Mat3 h = HomographyToQuad(corners_px);
  float sum = 0.0F, squares = 0.0F;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec2 pixel = Apply(h, {2.0 * points_[i].column - 1.0, 1.0 - 2.0 * points_[i].row});
    const int x = static_cast<int>(std::clamp(pixel.x + 0.5, 0.0, grey.width() - 1.0));
    const int y = static_cast<int>(std::clamp(pixel.y + 0.5, 0.0, grey.height() - 1.0));
    const float value = grey(x, y);
    seen_[i] = value;
    sum += value;
    squares += value * value;
  }
  const float n = static_cast<float>(points_.size());
  const float spread = std::sqrt(std::max(1e-3F, squares - sum * sum / n));
  std::array<ProbedOrientation, 2> best{};
  best[0].correlation = best[1].correlation = -2.0;
  for (int k = 0; k < 8; ++k) {
    float product = 0.0F;
    for (std::size_t i = 0; i < points_.size(); ++i) product += ideal_[i] * seen_[points_[i].at[k]];
    ProbedOrientation here;
    here.correlation = product / spread;
    here.mirrored = k >= 4;
    // The print's top-left corner, turned k times clockwise, lies at the quadrilateral's corner k;
    // mirrored before, it begins at the next.
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
