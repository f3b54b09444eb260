#include "tracker/surf_golay/cells/corner_points.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

constexpr int kReach = 2;       ///< The structure tensor is summed over 5×5 pixels;
constexpr int kPlaceReach = 3;  ///< … a corner is localised over 7×7 pixels.
constexpr int kRival = 2;       ///< A corner is the maximum of 5×5 pixels.
constexpr int kBorder = kPlaceReach + 1;
constexpr float kMinRoundness = 0.25F;
/// Two edges of 12 digital numbers that meet in the window: each five pixels long and two wide.
constexpr float kMinWeight = 400.0F;
constexpr int kTile_px = 48;
constexpr std::size_t kMaxPerTile = 24;

}  // namespace

void CornerPoints::AddRow(ImageView<const std::uint8_t> grey, int y, float sign) {
  const int width = grey.width();
  const std::uint8_t* above = grey.row(y - 1);
  const std::uint8_t* here = grey.row(y);
  const std::uint8_t* below = grey.row(y + 1);
  float* xx = column_xx_.data();
  float* xy = column_xy_.data();
  float* yy = column_yy_.data();
  for (int x = 1; x < width - 1; ++x) {
    const float gx = 0.5F * static_cast<float>(here[x + 1] - here[x - 1]);
    const float gy = 0.5F * static_cast<float>(below[x] - above[x]);
    xx[x] += sign * gx * gx;
    xy[x] += sign * gx * gy;
    yy[x] += sign * gy * gy;
  }
}

Vec2 CornerPoints::Place(ImageView<const std::uint8_t> grey, int x, int y) const {
  double xx = 0.0, xy = 0.0, yy = 0.0, bx = 0.0, by = 0.0;
  for (int v = -kPlaceReach; v <= kPlaceReach; ++v) {
    for (int u = -kPlaceReach; u <= kPlaceReach; ++u) {
      const double gx = 0.5 * (grey(x + u + 1, y + v) - grey(x + u - 1, y + v));
      const double gy = 0.5 * (grey(x + u, y + v + 1) - grey(x + u, y + v - 1));
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
      bx += gx * gx * u + gx * gy * v;
      by += gx * gy * u + gy * gy * v;
    }
  }
  const double determinant = xx * yy - xy * xy;
  const Vec2 offset{(yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant};
  const Vec2 pixel{static_cast<double>(x), static_cast<double>(y)};
  // Farther away, the edges of another corner meet.
  if (!(std::fabs(offset.x) < kPlaceReach && std::fabs(offset.y) < kPlaceReach)) return pixel;
  return pixel + offset;
}

const std::vector<CornerPoint>& CornerPoints::Find(ImageView<const std::uint8_t> grey) {
  const int width = grey.width(), height = grey.height();
  corners_.clear();
  found_.clear();
  if (width <= 2 * kBorder || height <= 2 * kBorder) return corners_;
  weight_.assign(static_cast<std::size_t>(width) * height, 0.0F);
  for (std::vector<float>* column : {&column_xx_, &column_xy_, &column_yy_}) {
    column->assign(width, 0.0F);
  }
  // All terms are quarters of integers below 2²⁴, so sums stay exact when terms are added and
  // subtracted.
  for (int y = 1; y <= 2 * kReach; ++y) AddRow(grey, y, 1.0F);
  for (int y = 1 + kReach; y + kReach < height - 1; ++y) {
    AddRow(grey, y + kReach, 1.0F);
    float* row = weight_.data() + static_cast<std::size_t>(y) * width;
    for (int x = 1 + kReach; x < width - 1 - kReach; ++x) {
      const float* cxx = column_xx_.data() + x;
      const float* cxy = column_xy_.data() + x;
      const float* cyy = column_yy_.data() + x;
      const float xx = cxx[-2] + cxx[-1] + cxx[0] + cxx[1] + cxx[2];
      const float xy = cxy[-2] + cxy[-1] + cxy[0] + cxy[1] + cxy[2];
      const float yy = cyy[-2] + cyy[-1] + cyy[0] + cyy[1] + cyy[2];
      const float trace = xx + yy, determinant = xx * yy - xy * xy;
      const bool corner = 4.0F * determinant > kMinRoundness * trace * trace;
      row[x] = corner ? determinant / (trace + 1.0F) : 0.0F;
    }
    AddRow(grey, y - kReach, -1.0F);
  }
  for (int y = kBorder; y < height - kBorder; ++y) {
    const float* row = weight_.data() + static_cast<std::size_t>(y) * width;
    for (int x = kBorder; x < width - kBorder; ++x) {
      const float weight = row[x];
      if (weight < kMinWeight || weight < row[x - 1] || weight <= row[x + 1]) continue;
      bool strongest = true;
      for (int v = -kRival; strongest && v <= kRival; ++v) {
        const float* other = row + static_cast<std::ptrdiff_t>(v) * width + x;
        for (int u = -kRival; u <= kRival; ++u) {
          // If several are equal, the last one counts.
          const bool later = v > 0 || (v == 0 && u > 0);
          if (later ? other[u] >= weight : other[u] > weight) strongest = false;
        }
      }
      if (strongest) {
        found_.push_back({{static_cast<double>(x), static_cast<double>(y)}, weight});
      }
    }
  }
  KeepStrongest(width);
  for (CornerPoint& corner : corners_) {
    corner.at_px = Place(grey, static_cast<int>(corner.at_px.x), static_cast<int>(corner.at_px.y));
  }
  return corners_;
}

void CornerPoints::KeepStrongest(int width) {
  // found_ is sorted by rows: the tiles of one row of tiles are contiguous once sorted by columns.
  const auto tile = [&](const CornerPoint& corner) {
    const int columns = (width + kTile_px - 1) / kTile_px;
    return static_cast<int>(corner.at_px.y) / kTile_px * columns +
           static_cast<int>(corner.at_px.x) / kTile_px;
  };
  std::ranges::stable_sort(found_, {}, tile);
  for (auto first = found_.begin(); first != found_.end();) {
    const auto last = std::find_if(first, found_.end(), [&](const CornerPoint& corner) {
      return tile(corner) != tile(*first);
    });
    const auto kept = first + std::min<std::ptrdiff_t>(kMaxPerTile, last - first);
    std::partial_sort(first, kept, last, [](const CornerPoint& a, const CornerPoint& b) {
      return a.strength > b.strength;
    });
    for (auto corner = first; corner != kept; ++corner) {
      corner->rank = static_cast<int>(corner - first);
      corners_.push_back(*corner);
    }
    first = last;
  }
}

}  // namespace pleinair::tracker
