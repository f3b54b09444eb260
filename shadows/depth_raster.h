#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/image.h"

namespace pleinair::shadows {

/// A rectangle of a map's texels, without its upper limits.
struct TexelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool Empty() const { return x0 >= x1 || y0 >= y1; }
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  /// The smallest rectangle around both.
  TexelRect UnitedWith(const TexelRect& other) const;
};

/// Indexed triangles in memory.
struct TriangleSpan {
  std::span<const std::array<float, 3>> positions;
  std::span<const std::uint32_t> indices;
};

/// Draws depths of triangles on the processor, as OpenGL does with depth clamping. The least depth
/// at a texel's centre counts. Only triangles that run counter-clockwise in the map are drawn.
/// Corners are rounded to 1/256 texel, so that no gap opens between neighbours.
///
/// A software renderer of OpenGL divides triangles into blocks of a screen first. For the small
/// triangles of a dense mesh that takes several times as long.
class DepthRaster {
 public:
  /// `texel_from_model`: to (column, row, depth); the first texel's centre is at (0.5, 0.5), depth
  /// 0…1 over the map's range. Affine.
  DepthRaster(const TriangleSpan& triangles, const glm::dmat4& texel_from_model, int side);

  /// The texels that triangles may cover.
  const TexelRect& bounds() const { return bounds_; }

  /// Lowers `depths` (row 0 at the lowest v) where triangles are nearer. Does not depend on the
  /// number of threads.
  void Draw(Image<float>* depths) const;

 private:
  struct Corner {
    std::int32_t x = 0, y = 0;  ///< In 1/256 texel.
    float depth = 0.0F;
  };
  void DrawRows(int first, int last, Image<float>* depths) const;

  std::span<const std::uint32_t> indices_;
  std::vector<Corner> corners_;  ///< By position.
  TexelRect bounds_;
};

}  // namespace pleinair::shadows
