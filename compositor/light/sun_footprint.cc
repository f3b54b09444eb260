#include "compositor/light/sun_footprint.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kFootprintBlock = 16'384;

}  // namespace

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

void SunFootprint::Include(std::span<const glm::vec2> at, std::span<const std::uint32_t> indices) {
  // Cells of the vertices first: those of a triangle lie between its corners'.
  struct Range {
    std::uint8_t first_row = 0, last_row = 0, first_column = 0, last_column = 0;
  };
  const glm::vec2 last(kCells - 1);
  std::vector<Range> ranges(at.size());
  ParallelForBlocks(at.size(), kFootprintBlock, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const glm::vec2 low = (at[i] - reach_) * cells_per_unit_;
      const glm::vec2 high = (at[i] + reach_) * cells_per_unit_;
      // If a coordinate is not a number, the place is unknown.
      if (!(low.x <= high.x && low.y <= high.y)) {
        ranges[i] = {0, kCells - 1, 0, kCells - 1};
        continue;
      }
      const glm::ivec2 from(glm::clamp(low, glm::vec2(0.0F), last));
      const glm::ivec2 to(glm::clamp(high, glm::vec2(0.0F), last));
      ranges[i] = {static_cast<std::uint8_t>(from.y), static_cast<std::uint8_t>(to.y),
                   static_cast<std::uint8_t>(from.x), static_cast<std::uint8_t>(to.x)};
    }
  });
  const std::size_t triangles = indices.size() / 3;
  std::vector<Rows> rows((triangles + kFootprintBlock - 1) / kFootprintBlock);
  ParallelForBlocks(triangles, kFootprintBlock, [&](std::size_t first, std::size_t end) {
    Rows& own = rows[first / kFootprintBlock];
    std::uint64_t last_columns = 0;
    std::array<int, 2> last_rows{};
    for (std::size_t i = 3 * first; i < 3 * end; i += 3) {
      const Range &a = ranges[indices[i]], &b = ranges[indices[i + 1]], &c = ranges[indices[i + 2]];
      const int column = std::min({a.first_column, b.first_column, c.first_column});
      const int count = std::max({a.last_column, b.last_column, c.last_column}) - column;
      const std::uint64_t columns = (~std::uint64_t{0} >> (kCells - 1 - count)) << column;
      const int first_row = std::min({a.first_row, b.first_row, c.first_row});
      const int last_row = std::max({a.last_row, b.last_row, c.last_row});
      // Neighbours mostly cover the same cells.
      if (columns == last_columns && first_row == last_rows[0] && last_row == last_rows[1]) {
        continue;
      }
      last_columns = columns;
      last_rows = {first_row, last_row};
      for (int row = first_row; row <= last_row; ++row) {
        own[static_cast<std::size_t>(row)] |= columns;
      }
    }
  });
  for (const Rows& own : rows) {
    for (std::size_t row = 0; row < kCells; ++row) rows_[row] |= own[row];
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
