#include "shadows/depth_raster.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>

#include "base/parallel_for.h"

namespace pleinair::shadows {
namespace {

constexpr std::int32_t kSteps = 256;  // In a texel.
// Corners beyond the map by more than this are moved there: their products must fit into 64 bits.
constexpr float kFarOff = 1e6F;
constexpr std::size_t kCornersPerBlock = 8192;
// Most texels of wider rows may lie outside of a thin triangle.
constexpr int kWideRow = 12;

/// Narrows a row of texels to those where a function is not negative: `at_first` at texel 0, with a
/// change of `right` from one texel to the next.
void NarrowRow(std::int64_t at_first, std::int64_t right, int* begin, int* end) {
  if (right == 0) return;
  const double zero = std::floor(-static_cast<double>(at_first) / static_cast<double>(right));
  const int texel = static_cast<int>(std::clamp(zero, -1.0, static_cast<double>(*end)));
  if (right > 0) {
    *begin = std::max(*begin, texel);
  } else {
    *end = std::min(*end, texel + 1);
  }
}

/// First texel whose centre is not below a coordinate in 1/256 texel.
int FirstCentre(std::int32_t at) {
  return static_cast<int>((static_cast<std::int64_t>(at) + kSteps / 2 - 1) >> 8);
}

}  // namespace

TexelRect TexelRect::UnitedWith(const TexelRect& other) const {
  if (Empty()) return other;
  if (other.Empty()) return *this;
  return {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1),
          std::max(y1, other.y1)};
}

DepthRaster::DepthRaster(const TriangleSpan& triangles, const glm::dmat4& texel_from_model,
                         int side)
    : indices_(triangles.indices), corners_(triangles.positions.size()) {
  const glm::mat4 map(texel_from_model);
  const std::size_t count = corners_.size();
  const std::size_t blocks = (count + kCornersPerBlock - 1) / kCornersPerBlock;
  std::vector<glm::ivec4> extents(blocks, {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN});
  ParallelFor(blocks, 0, [&](std::size_t block) {
    glm::ivec4 extent = extents[block];
    const std::size_t last = std::min(count, (block + 1) * kCornersPerBlock);
    for (std::size_t i = block * kCornersPerBlock; i < last; ++i) {
      const auto& [x, y, z] = triangles.positions[i];
      const glm::vec3 at(map * glm::vec4(x, y, z, 1.0F));
      const auto fixed = [](float v) {
        return static_cast<std::int32_t>(std::lrintf(std::clamp(v, -kFarOff, kFarOff) * kSteps));
      };
      const Corner corner{fixed(at.x), fixed(at.y), std::clamp(at.z, 0.0F, 1.0F)};
      corners_[i] = corner;
      extent = {std::min(extent.x, corner.x), std::min(extent.y, corner.y),
                std::max(extent.z, corner.x), std::max(extent.w, corner.y)};
    }
    extents[block] = extent;
  });
  if (corners_.empty()) return;
  glm::ivec4 extent = extents[0];
  for (const glm::ivec4& other : extents) {
    extent = {std::min(extent.x, other.x), std::min(extent.y, other.y), std::max(extent.z, other.z),
              std::max(extent.w, other.w)};
  }
  const auto inside = [side](std::int32_t at) { return std::clamp(at / kSteps, -1, side); };
  bounds_ = {std::max(0, inside(extent.x)), std::max(0, inside(extent.y)),
             std::min(side, inside(extent.z) + 1), std::min(side, inside(extent.w) + 1)};
}

void DepthRaster::Draw(Image<float>* depths) const {
  if (bounds_.Empty()) return;
  // Bands of rows: every texel belongs to one.
  // Bands with few triangles would take less time than their threads.
  constexpr std::size_t kTrianglesPerBand = 5000;
  const auto processors = std::clamp(std::thread::hardware_concurrency(), 1U, 4U);
  const auto bands = static_cast<int>(
      std::clamp<std::size_t>(indices_.size() / (3 * kTrianglesPerBand), 1, processors));
  std::vector<std::uint8_t> band_of(static_cast<std::size_t>(bounds_.height()));
  const auto first_row = [&](int band) { return bounds_.height() * band / bands; };
  for (int band = 0; band < bands; ++band) {
    std::fill(band_of.begin() + first_row(band), band_of.begin() + first_row(band + 1),
              static_cast<std::uint8_t>(band));
  }
  const auto triangles = TrianglesOf(band_of);
  ParallelFor(static_cast<std::size_t>(bands), 0, [&](std::size_t band) {
    const auto i = static_cast<int>(band);
    for (const auto& block : triangles) {
      DrawRows(block[band], bounds_.y0 + first_row(i), bounds_.y0 + first_row(i + 1), depths);
    }
  });
}

std::vector<std::vector<std::vector<std::uint32_t>>> DepthRaster::TrianglesOf(
    const std::vector<std::uint8_t>& bands) const {
  const std::size_t count = indices_.size() / 3;
  std::vector<std::vector<std::vector<std::uint32_t>>> triangles((count + kCornersPerBlock - 1) /
                                                                 kCornersPerBlock);
  ParallelForBlocks(count, kCornersPerBlock, [&](std::size_t begin, std::size_t end) {
    auto& own = triangles[begin / kCornersPerBlock];
    own.resize(std::size_t{1} + bands.back());
    for (auto& band : own) band.reserve((end - begin) / 2);
    for (std::size_t i = begin; i < end; ++i) {
      const Corner &a = corners_[indices_[3 * i]], &b = corners_[indices_[3 * i + 1]],
                   &c = corners_[indices_[3 * i + 2]];
      const std::int64_t abx = b.x - a.x, aby = b.y - a.y, acx = c.x - a.x, acy = c.y - a.y;
      if (abx * acy - aby * acx <= 0) continue;
      const int y0 = std::max(FirstCentre(std::min({a.y, b.y, c.y})), bounds_.y0) - bounds_.y0;
      const int y1 = std::min(FirstCentre(std::max({a.y, b.y, c.y}) + 1), bounds_.y1) - bounds_.y0;
      if (y0 >= y1) continue;
      const std::size_t last = bands[static_cast<std::size_t>(y1) - 1];
      for (std::size_t band = bands[static_cast<std::size_t>(y0)]; band <= last; ++band) {
        own[band].push_back(static_cast<std::uint32_t>(3 * i));
      }
    }
  });
  return triangles;
}

void DepthRaster::DrawRows(const std::vector<std::uint32_t>& triangles, int first, int last,
                           Image<float>* depths) const {
  for (const std::uint32_t i : triangles) {
    const Corner &a = corners_[indices_[i]], &b = corners_[indices_[i + 1]],
                 &c = corners_[indices_[i + 2]];
    const std::int64_t abx = b.x - a.x, aby = b.y - a.y, acx = c.x - a.x, acy = c.y - a.y;
    const std::int64_t area = abx * acy - aby * acx;
    const int y0 = std::max(FirstCentre(std::min({a.y, b.y, c.y})), first);
    const int y1 = std::min(FirstCentre(std::max({a.y, b.y, c.y}) + 1), last);
    const int x0 = std::max(FirstCentre(std::min({a.x, b.x, c.x})), bounds_.x0);
    const int x1 = std::min(FirstCentre(std::max({a.x, b.x, c.x}) + 1), bounds_.x1);
    if (y0 >= y1 || x0 >= x1) continue;
    // Twice the areas opposite to the corners, at the first texel's centre, and their changes.
    const std::int64_t px = std::int64_t{x0} * kSteps + kSteps / 2 - a.x;
    const std::int64_t py = std::int64_t{y0} * kSteps + kSteps / 2 - a.y;
    std::int64_t row_b = px * acy - py * acx, row_c = abx * py - aby * px;
    const std::int64_t b_right = acy * kSteps, b_up = -acx * kSteps;
    const std::int64_t c_right = -aby * kSteps, c_up = abx * kSteps;
    const std::int64_t a_right = -b_right - c_right;
    const float scale = 1.0F / static_cast<float>(area);
    const float to_b = (b.depth - a.depth) * scale, to_c = (c.depth - a.depth) * scale;
    const float depth_right =
        to_b * static_cast<float>(b_right) + to_c * static_cast<float>(c_right);
    for (int y = y0; y < y1; ++y, row_b += b_up, row_c += c_up) {
      const std::int64_t row_a = area - row_b - row_c;
      int begin = 0, end = x1 - x0;
      if (end > kWideRow) {
        NarrowRow(row_a, a_right, &begin, &end);
        NarrowRow(row_b, b_right, &begin, &end);
        NarrowRow(row_c, c_right, &begin, &end);
      }
      float* row = &(*depths)(x0, y);
      const float depth =
          a.depth + to_b * static_cast<float>(row_b) + to_c * static_cast<float>(row_c);
      std::int64_t at_a = row_a + begin * a_right, at_b = row_b + begin * b_right,
                   at_c = row_c + begin * c_right;
      for (int x = begin; x < end; ++x, at_a += a_right, at_b += b_right, at_c += c_right) {
        if ((at_a | at_b | at_c) < 0) continue;  // One of them is negative.
        row[x] = std::min(row[x], depth + static_cast<float>(x) * depth_right);
      }
    }
  }
}

}  // namespace pleinair::shadows
