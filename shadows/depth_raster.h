#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/image.h"

namespace pleinair::shadows {

/// A rectangle of a map's texels: x0 ≤ x < x1, y0 ≤ y < y1.
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

/// Rasterizes depths of triangles on the processor, by the rules of OpenGL with depth clamping.
/// Each texel gets the minimum depth at its centre. Only triangles that run counter-clockwise in
/// the map are drawn. Corners are rounded to 1/256 texel, so that no gap opens between neighbours.
///
/// A software renderer of OpenGL first sorts triangles into blocks of the image. It takes several
/// times as long for the small triangles of a dense mesh.
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
  /// Numbers of the triangles that run counter-clockwise and reach a row of each band, in blocks:
  /// [block][band]. `bands`: by row of bounds().
  std::vector<std::vector<std::vector<std::uint32_t>>> TrianglesOf(
      const std::vector<std::uint8_t>& bands) const;
  void DrawRows(const std::vector<std::uint32_t>& triangles, int first, int last,
                Image<float>* depths) const;

  std::span<const std::uint32_t> indices_;
  std::vector<Corner> corners_;  ///< By position.
  TexelRect bounds_;
};

}  // namespace pleinair::shadows
