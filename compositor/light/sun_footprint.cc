#include "compositor/light/sun_footprint.h"

#include <cstddef>

namespace pleinair::compositor {

SunFootprint::SunFootprint(const SunWindow& window)
    : cells_per_unit_(static_cast<float>(kCells) / window.side),
      reach_(window.reach_m * glm::vec2(glm::length(glm::vec3(window.u_from_marker)),
                                        glm::length(glm::vec3(window.v_from_marker)))) {}

SunFootprint::Cells SunFootprint::CellsOf(const glm::vec2& low, const glm::vec2& high) const {
  const glm::vec2 last(kCells - 1);
  const glm::vec2 low_cell = glm::clamp(glm::floor(low * cells_per_unit_), glm::vec2(0.0F), last);
  const glm::vec2 high_cell = glm::clamp(glm::floor(high * cells_per_unit_), glm::vec2(0.0F), last);
  // If a corner is not a number or the corners are swapped, the place is unknown.
  if (!(low_cell.x <= high_cell.x && low_cell.y <= high_cell.y)) {
    return {0, kCells - 1, ~std::uint64_t{0}};
  }
  const glm::ivec2 from(low_cell), to(high_cell);
  return {from.y, to.y, (~std::uint64_t{0} >> (kCells - 1 - (to.x - from.x))) << from.x};
}

void SunFootprint::Include(const glm::vec2& low, const glm::vec2& high) {
  const Cells cells = CellsOf(low - reach_, high + reach_);
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    rows_[static_cast<std::size_t>(row)] |= cells.columns;
  }
}

bool SunFootprint::Touches(const glm::vec2& low, const glm::vec2& high) const {
  const Cells cells = CellsOf(low, high);
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    if ((rows_[static_cast<std::size_t>(row)] & cells.columns) != 0) return true;
  }
  return false;
}

}  // namespace pleinair::compositor
