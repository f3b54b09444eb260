#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pleinair::compositor {

/// A rectangle of pixels, as glScissor takes it: (x, y) is the pixel at the lowest x and y.
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PixelRect&) const = default;
};

/// How positions are projected into an image, for finding the tiles that they affect.
struct SceneProjection {
  int width = 0, height = 0;  ///< Pixels.
  /// Max. distance by which later passes, such as the blur, spread what is drawn.
  int spread_px = 0;
  glm::mat4 clip_from_position{1.0F};  ///< To OpenGL's clip space; w is the depth in metres.
  float near_m = 0.0F;                 ///< Nearer parts are not drawn.
  /// Whether triangles of AffectedTriangles::kSunlitSky need the full resolution.
  bool resolves_sunlit_sky = false;
};

/// Square tiles of an image that a pass has to draw. Row 0 is the row of gl_FragCoord's y = 0.5.
/// Mesa's software renderer sorts its work into squares of the same size and position, so a pass
/// over whole tiles costs nothing along their borders.
class ImageTiles {
 public:
  static constexpr int kSide_px = 64;

  /// No tile of an image.
  ImageTiles(int width, int height);
  explicit ImageTiles(const SceneProjection& image) : ImageTiles(image.width, image.height) {}

  /// Adds all tiles.
  void IncludeAll();
  /// Adds tiles of an image of the same size.
  void Include(const ImageTiles& other);
  /// Adds the tiles that a rectangle touches, in pixels with centres at .5.
  void Include(glm::vec2 low, glm::vec2 high);
  /// Adds the tiles that triangles may affect in an image of the same size. `indices`: three a
  /// triangle.
  void Include(const SceneProjection& image, std::span<const glm::vec3> positions,
               std::span<const std::uint32_t> indices);

  /// Returns whether a rectangle, in pixels with centres at .5, touches a tile of the set.
  bool Touches(glm::vec2 low, glm::vec2 high) const;
  /// Returns disjoint rectangles that together are the tiles of the set.
  std::vector<PixelRect> Rectangles() const;
  /// Returns the tiles of the set that another one lacks.
  ImageTiles Without(const ImageTiles& other) const;
  /// Returns the tiles of the set for whose pixels `chosen` returns true.
  ImageTiles Where(const std::function<bool(const PixelRect&)>& chosen) const;
  /// Returns the number of tiles of the set.
  int Count() const;
  /// Returns the smallest rectangle with all tiles of the set.
  PixelRect Bounds() const;

 private:
  struct Range {
    glm::ivec2 first{0}, last{-1};  // Tiles; empty where a last one is smaller.
  };
  Range RangeOf(glm::vec2 low, glm::vec2 high) const;
  void Include(const Range& range);
  /// Adds the tiles of a triangle of which a part is nearer than `near_m`, by its corners in clip
  /// space. Adds all tiles if a coordinate is not a number.
  void IncludeCut(const std::array<glm::vec4, 3>& clip, float near_m, float margin_px);

  glm::ivec2 size_px_, tiles_;
  std::vector<char> included_;  // Row by row.
};

/// Splits rectangles of whole tiles into these.
std::vector<PixelRect> TilesOf(std::span<const PixelRect> rectangles);

/// Tiles that virtual objects affect.
struct AffectedTiles {
  ImageTiles objects;  ///< With objects in them.
  ImageTiles fine;     ///< Also those with a change that a coarse grid does not resolve.
  ImageTiles all;      ///< Also those with surfaces whose light changes.
};

/// Draws three vertices without attributes, as shaders/screen_triangle.vert takes them, into each
/// of the rectangles. Afterwards the scissor test is off.
void DrawWithin(std::span<const PixelRect> rectangles);

}  // namespace pleinair::compositor
