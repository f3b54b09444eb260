#include "compositor/surfaces/image_tiles.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

// Samples lie anywhere in a pixel, and a renderer rounds vertices; both within a pixel.
constexpr float kRounding_px = 2.0F;
constexpr float kNearest = 0.9F;  // Share of the near plane's depth, also for rounding.

constexpr std::size_t kTileBlock = 16'384;

/// Bounds of what is drawn of a triangle, pixels.
struct DrawnBounds {
  glm::vec2 low{1e30F}, high{-1e30F};
  bool is_known = true;  // False if a coordinate is not a number.
  void Add(const glm::vec4& clip, const glm::vec2& size_px) {
    const glm::vec2 at = (0.5F * glm::vec2(clip) / clip.w + 0.5F) * size_px;
    low = glm::min(low, at);
    high = glm::max(high, at);
    is_known = is_known && glm::all(glm::lessThan(glm::abs(at), glm::vec2(1e30F)));
  }
};

/// The tiles that a vertex may affect: those of a triangle lie between its corners'.
struct VertexTiles {
  // From −1 to the number of tiles, both of which are outside of the image.
  std::int16_t first_x = 0, first_y = 0, last_x = -1, last_y = -1;
  // False before the near plane, or if a coordinate is not a number.
  bool is_known = false;

  bool operator==(const VertexTiles&) const = default;
  /// The smallest range around both.
  VertexTiles UnitedWith(const VertexTiles& other) const {
    return {std::min(first_x, other.first_x), std::min(first_y, other.first_y),
            std::max(last_x, other.last_x), std::max(last_y, other.last_y),
            is_known && other.is_known};
  }
};

}  // namespace

ImageTiles::ImageTiles(int width, int height)
    : size_px_(width, height),
      tiles_((width + kSide_px - 1) / kSide_px, (height + kSide_px - 1) / kSide_px),
      included_(static_cast<std::size_t>(tiles_.x) * static_cast<std::size_t>(tiles_.y), 0) {}

void ImageTiles::IncludeAll() { std::fill(included_.begin(), included_.end(), 1); }

void ImageTiles::Include(const ImageTiles& other) {
  std::transform(included_.begin(), included_.end(), other.included_.begin(), included_.begin(),
                 [](char a, char b) { return static_cast<char>(a | b); });
}

ImageTiles::Range ImageTiles::RangeOf(glm::vec2 low, glm::vec2 high) const {
  const glm::vec2 size(size_px_);
  // Also where a coordinate is not a number: then the whole extent counts.
  if (!(low.x < size.x && low.y < size.y && high.x >= 0.0F && high.y >= 0.0F)) {
    const bool is_outside = low.x >= size.x || low.y >= size.y || high.x < 0.0F || high.y < 0.0F;
    return is_outside ? Range{} : Range{glm::ivec2(0), tiles_ - 1};
  }
  const glm::vec2 side(kSide_px);
  return {glm::ivec2(glm::max(low, glm::vec2(0.0F)) / side),
          glm::min(glm::ivec2(glm::min(high, size) / side), tiles_ - 1)};
}

void ImageTiles::Include(glm::vec2 low, glm::vec2 high) { Include(RangeOf(low, high)); }

void ImageTiles::Include(const Range& range) {
  for (int y = range.first.y; y <= range.last.y; ++y) {
    const auto row = included_.begin() + static_cast<std::ptrdiff_t>(y) * tiles_.x;
    if (range.last.x >= range.first.x) std::fill(row + range.first.x, row + range.last.x + 1, 1);
  }
}

void ImageTiles::Include(const SceneProjection& image, std::span<const glm::vec3> positions,
                         std::span<const std::uint32_t> indices) {
  const glm::vec2 size(size_px_);
  const float margin_px = kRounding_px + static_cast<float>(image.spread_px);
  const float near_m = kNearest * image.near_m;
  const auto clip_of = [&](std::uint32_t vertex) {
    return image.clip_from_position * glm::vec4(positions[vertex], 1.0F);
  };
  const auto tiles_of = [&](std::uint32_t vertex) {
    const glm::vec4 clip = clip_of(vertex);
    if (!(clip.w >= near_m)) return VertexTiles{};
    const glm::vec2 at = (0.5F * glm::vec2(clip) / clip.w + 0.5F) * size;
    if (!glm::all(glm::lessThan(glm::abs(at), glm::vec2(1e30F)))) return VertexTiles{};
    const auto tile = [](float at_px, int count) {
      return static_cast<std::int16_t>(
          std::clamp(std::floor(at_px / kSide_px), -1.0F, static_cast<float>(count)));
    };
    return VertexTiles{tile(at.x - margin_px, tiles_.x), tile(at.y - margin_px, tiles_.y),
                       tile(at.x + margin_px, tiles_.x), tile(at.y + margin_px, tiles_.y), true};
  };
  // A few triangles of a large mesh need few of its vertices.
  std::vector<VertexTiles> vertices(indices.size() < positions.size() ? 0 : positions.size());
  ParallelForBlocks(vertices.size(), kTileBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      vertices[i] = tiles_of(static_cast<std::uint32_t>(i));
    }
  });
  const auto corner_of = [&](std::uint32_t vertex) {
    return vertices.empty() ? tiles_of(vertex) : vertices[vertex];
  };
  const std::size_t triangles = indices.size() / 3;
  std::vector<ImageTiles> found((triangles + kTileBlock - 1) / kTileBlock,
                                ImageTiles(size_px_.x, size_px_.y));
  ParallelForBlocks(triangles, kTileBlock, [&](std::size_t first, std::size_t last) {
    ImageTiles& own = found[first / kTileBlock];
    VertexTiles before;
    for (std::size_t i = 3 * first; i < 3 * last; i += 3) {
      const VertexTiles range = corner_of(indices[i])
                                    .UnitedWith(corner_of(indices[i + 1]))
                                    .UnitedWith(corner_of(indices[i + 2]));
      if (!range.is_known) {
        own.IncludeCut({clip_of(indices[i]), clip_of(indices[i + 1]), clip_of(indices[i + 2])},
                       near_m, margin_px);
        continue;
      }
      // Neighbors mostly affect the same tiles.
      if (range == before) continue;
      before = range;
      own.Include({glm::max(glm::ivec2(range.first_x, range.first_y), 0),
                   glm::min(glm::ivec2(range.last_x, range.last_y), tiles_ - 1)});
    }
  });
  for (const ImageTiles& own : found) Include(own);
}

void ImageTiles::IncludeCut(const std::array<glm::vec4, 3>& clip, float near_m, float margin_px) {
  DrawnBounds bounds;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec4 &from = clip[k], &to = clip[(k + 1) % 3];
    // Written so that a depth which is not a number is in front.
    if (!(from.w < near_m)) bounds.Add(from, glm::vec2(size_px_));
    if ((from.w < near_m) != (to.w < near_m)) {
      bounds.Add(glm::mix(from, to, (near_m - from.w) / (to.w - from.w)), glm::vec2(size_px_));
    }
  }
  if (!bounds.is_known) {
    IncludeAll();
  } else if (bounds.low.x <= bounds.high.x) {
    Include(bounds.low - margin_px, bounds.high + margin_px);
  }
}

bool ImageTiles::Touches(glm::vec2 low, glm::vec2 high) const {
  const auto [first, last] = RangeOf(low, high);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      if (included_.begin()[static_cast<std::ptrdiff_t>(y) * tiles_.x + x] != 0) return true;
    }
  }
  return false;
}

std::vector<PixelRect> ImageTiles::Rectangles() const {
  std::vector<char> left = included_;
  const auto is_run = [&](int y, int first, int end) {
    const auto row = left.begin() + static_cast<std::ptrdiff_t>(y) * tiles_.x;
    return std::find(row + first, row + end, 0) == row + end;
  };
  std::vector<PixelRect> rectangles;
  for (int y = 0; y < tiles_.y; ++y) {
    for (int x = 0; x < tiles_.x; ++x) {
      int right = x;
      while (right < tiles_.x && is_run(y, right, right + 1)) ++right;
      if (right == x) continue;
      int bottom = y + 1;
      while (bottom < tiles_.y && is_run(bottom, x, right)) ++bottom;
      for (int row = y; row < bottom; ++row) {
        const auto begin = left.begin() + static_cast<std::ptrdiff_t>(row) * tiles_.x;
        std::fill(begin + x, begin + right, 0);
      }
      const glm::ivec2 end = glm::min(glm::ivec2(right, bottom) * kSide_px, size_px_);
      rectangles.push_back(
          {x * kSide_px, y * kSide_px, end.x - x * kSide_px, end.y - y * kSide_px});
    }
  }
  return rectangles;
}

ImageTiles ImageTiles::Without(const ImageTiles& other) const {
  ImageTiles tiles = *this;
  std::transform(included_.begin(), included_.end(), other.included_.begin(),
                 tiles.included_.begin(),
                 [](char here, char there) { return static_cast<char>(here & ~there & 1); });
  return tiles;
}

ImageTiles ImageTiles::Where(const std::function<bool(const PixelRect&)>& chosen) const {
  ImageTiles tiles(size_px_.x, size_px_.y);
  for (int y = 0; y < tiles_.y; ++y) {
    for (int x = 0; x < tiles_.x; ++x) {
      const auto at = static_cast<std::ptrdiff_t>(y) * tiles_.x + x;
      if (included_.begin()[at] == 0) continue;
      const glm::ivec2 first = glm::ivec2(x, y) * kSide_px;
      const glm::ivec2 size = glm::min(glm::ivec2(kSide_px), size_px_ - first);
      tiles.included_.begin()[at] = chosen({first.x, first.y, size.x, size.y}) ? 1 : 0;
    }
  }
  return tiles;
}

int ImageTiles::Count() const {
  return static_cast<int>(std::count(included_.begin(), included_.end(), 1));
}

PixelRect ImageTiles::Bounds() const {
  glm::ivec2 low = size_px_, high(0);
  for (const PixelRect& r : Rectangles()) {
    low = glm::min(low, glm::ivec2(r.x, r.y));
    high = glm::max(high, glm::ivec2(r.x + r.width, r.y + r.height));
  }
  if (low.x >= high.x) return {};
  return {low.x, low.y, high.x - low.x, high.y - low.y};
}

std::vector<PixelRect> TilesOf(std::span<const PixelRect> rectangles) {
  constexpr int kSide = ImageTiles::kSide_px;
  std::vector<PixelRect> tiles;
  for (const PixelRect& rect : rectangles) {
    for (int y = rect.y; y < rect.y + rect.height; y += kSide) {
      for (int x = rect.x; x < rect.x + rect.width; x += kSide) {
        tiles.push_back({x, y, std::min(kSide, rect.x + rect.width - x),
                         std::min(kSide, rect.y + rect.height - y)});
      }
    }
  }
  return tiles;
}

void DrawWithin(std::span<const PixelRect> rectangles) {
  glEnable(GL_SCISSOR_TEST);
  for (const PixelRect& r : rectangles) {
    glScissor(r.x, r.y, r.width, r.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace pleinair::compositor
