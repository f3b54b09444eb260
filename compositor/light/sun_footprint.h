#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace pleinair::compositor {

/// Where virtual objects may change the sun's light: a square across the sun's rays, in the layout
/// of shadows::ShadowSliceUniforms.
struct SunWindow {
  glm::vec4 u_from_marker{0.0F}, v_from_marker{0.0F};
  float side = 0.0F;  ///< Side of the square from coordinate 0, in texels of the finest shadow map.
  glm::vec3 to_sun{0.0F};  ///< Unit; zero without a sun.
  float reach_m = 0.0F;    ///< Max. distance of a penumbra from its object's own footprint.
  bool operator==(const SunWindow&) const = default;

  /// A window without bounds, for maps that do not report theirs.
  static SunWindow Everywhere(const glm::vec3& to_sun) {
    const glm::vec4 inside(0.0F, 0.0F, 0.0F, 1.0F);
    return {inside, inside, 2.0F, to_sun};
  }
  /// Where a point's ray intersects the square, in the units of `side`.
  glm::vec2 At(const glm::vec3& position_m) const {
    return {glm::dot(u_from_marker, glm::vec4(position_m, 1.0F)),
            glm::dot(v_from_marker, glm::vec4(position_m, 1.0F))};
  }
};

/// Shadow-volume bounds in light space: the cells of a window that objects may shade. Objects cover
/// their own bounds across the sun's rays, extended by the window's reach. Most of the window, a
/// box around all objects, is empty.
class SunFootprint {
 public:
  static constexpr int kCells = 64;  ///< Cells per side.

  /// Covers the whole window, for as long as the objects are unknown.
  SunFootprint() { rows_.fill(~std::uint64_t{0}); }
  /// Covers nothing of `window`, whose side is not 0.
  explicit SunFootprint(const SunWindow& window);

  /// Adds an object's triangles, by the coordinates SunWindow::At() of its vertices. If one is not
  /// a number, its triangles may be anywhere.
  void Include(std::span<const glm::vec2> at, std::span<const std::uint32_t> indices);
  /// Returns whether objects may shade a region between two corners.
  bool Touches(const glm::vec2& low, const glm::vec2& high) const;

 private:
  using Rows = std::array<std::uint64_t, kCells>;
  struct Cells {
    int first_row = 0, last_row = 0;
    std::uint64_t columns = 0;  // One bit each.
  };
  Cells CellsOf(const glm::vec2& low, const glm::vec2& high) const;

  float cells_per_unit_ = 0.0F;
  glm::vec2 reach_{0.0F};
  Rows rows_{};
};

}  // namespace pleinair::compositor
