#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace pleinair::compositor {

/// Where virtual objects may change the sun's light: a square across its rays, as
/// shadows::ShadowSliceUniforms has it.
struct SunWindow {
  glm::vec4 u_from_marker{0.0F}, v_from_marker{0.0F};
  float side = 0.0F;       ///< Of the square, from 0 on: texels of the finest shadow map.
  glm::vec3 to_sun{0.0F};  ///< Unit; zero without a sun.
  float reach_m = 0.0F;    ///< How far beside an object's own its penumbra may lie.
  bool operator==(const SunWindow&) const = default;

  /// For maps that do not say where they end.
  static SunWindow Everywhere(const glm::vec3& to_sun) {
    const glm::vec4 inside(0.0F, 0.0F, 0.0F, 1.0F);
    return {inside, inside, 2.0F, to_sun};
  }
  /// Where a point's ray crosses the square, in the units of `side`.
  glm::vec2 At(const glm::vec3& position_m) const {
    return {glm::dot(u_from_marker, glm::vec4(position_m, 1.0F)),
            glm::dot(v_from_marker, glm::vec4(position_m, 1.0F))};
  }
};

/// The part of a window that objects may really shade: what they cover across the sun's rays, with
/// the window's reach, in cells. A box around them, which the window is, is mostly empty.
class SunFootprint {
 public:
  static constexpr int kCells = 64;  ///< A side.

  /// The whole window, as long as nothing is known of the objects.
  SunFootprint() { rows_.fill(~std::uint64_t{0}); }
  /// Nothing of `window`, which has a side.
  explicit SunFootprint(const SunWindow& window);

  /// An object may lie between two corners, both as SunWindow::At() has them; anywhere, if one is
  /// not finite or `low` lies beyond `high`.
  void Include(const glm::vec2& low, const glm::vec2& high);
  /// Whether something between two such corners may be shaded.
  bool Touches(const glm::vec2& low, const glm::vec2& high) const;

 private:
  struct Cells {
    int first_row = 0, last_row = 0;
    std::uint64_t columns = 0;  // A bit each.
  };
  Cells CellsOf(const glm::vec2& low, const glm::vec2& high) const;

  float cells_per_unit_ = 0.0F;
  glm::vec2 reach_{0.0F};
  std::array<std::uint64_t, kCells> rows_{};
};

}  // namespace pleinair::compositor
