#include "shadows/depth_bounds.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "base/parallel_for.h"

namespace pleinair::shadows {
namespace {

constexpr std::size_t kRowsPerBlock = 32;

/// Bounds of 4×4 texels of the map.
void BoundDepths(const Image<float>& depths, int x, int y, Image<float>* level) {
  float low = 1e30F, high = -1e30F;
  for (int j = 4 * y; j < 4 * y + 4; ++j) {
    const float* row = &depths(4 * x, j);
    for (int i = 0; i < 4; ++i) {
      // Where nothing was drawn the surface is at infinity.
      const float depth = row[i] >= 1.0F ? row[i] + 1e6F : row[i];
      low = std::min(low, depth);
      high = std::max(high, depth);
    }
  }
  (*level)(x, y, 0) = low;
  (*level)(x, y, 1) = high;
}

/// Bounds of 2×2 texels of the level below.
void BoundLevel(const Image<float>& finer, int x, int y, Image<float>* level) {
  const float *a = &finer(2 * x, 2 * y), *b = &finer(2 * x, 2 * y + 1);
  (*level)(x, y, 0) = std::min(std::min(a[0], a[2]), std::min(b[0], b[2]));
  (*level)(x, y, 1) = std::max(std::max(a[1], a[3]), std::max(b[1], b[3]));
}

}  // namespace

void DepthBounds::Update(const Image<float>& depths, const TexelRect& changed, int levels,
                         int layer, const gl::GlTexture& bounds) {
  TexelRect texels = changed;
  if (levels_.empty()) {
    texels = {0, 0, depths.width(), depths.height()};
    for (int level = 0; level < levels; ++level) {
      levels_.emplace_back(depths.width() >> (level + 2), depths.height() >> (level + 2), 2);
    }
  }
  for (int level = 0; level < levels; ++level) {
    const auto first = [level](int texel) { return texel >> (level + 2); };
    const TexelRect at{first(texels.x0), first(texels.y0), first(texels.x1 - 1) + 1,
                       first(texels.y1 - 1) + 1};
    Image<float>& made = levels_[static_cast<std::size_t>(level)];
    ParallelForBlocks(static_cast<std::size_t>(at.height()), kRowsPerBlock,
                      [&](std::size_t begin, std::size_t end) {
                        for (int y = at.y0 + static_cast<int>(begin);
                             y < at.y0 + static_cast<int>(end); ++y) {
                          for (int x = at.x0; x < at.x1; ++x) {
                            if (level == 0) {
                              BoundDepths(depths, x, y, &made);
                            } else {
                              BoundLevel(levels_[static_cast<std::size_t>(level) - 1], x, y, &made);
                            }
                          }
                        }
                      });
    glPixelStorei(GL_UNPACK_ROW_LENGTH, made.width());
    glTextureSubImage3D(bounds.id(), level, at.x0, at.y0, layer, at.width(), at.height(), 1, GL_RG,
                        GL_FLOAT, &made(at.x0, at.y0));
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

}  // namespace pleinair::shadows
