#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "compositor/ink/ink_segments.h"
#include "compositor/ink/ink_shape.h"

namespace pleinair::compositor {

/// Shapes of ink, sorted into cells seen from above, so that a pixel finds those at its place
/// whatever their number (shaders/ink.frag). Map coordinates: east, north, up from the marker's
/// origin, metres.
///
/// Level l has square cells of cell_m · 2^l. A cell lists what lies within half a cell of it, so
/// that a pixel whose footprint reaches no farther from its center needs one cell of one level. A
/// cell with more than kMaxParts parts has the mean coverage of each shape instead.
class InkGrid {
 public:
  static constexpr std::size_t kMaxParts = 96;   ///< Segments and edges that a cell lists.
  static constexpr std::size_t kMaxShapes = 24;  ///< With the largest coverage, in a mean cell.
  static constexpr std::uint32_t kMeanBit = 1U << 31;

  struct Level {
    float cell_m = 0.0F;
    glm::ivec2 cells{0};
    std::uint32_t first_cell = 0;
  };
  /// A shape in a cell.
  struct Entry {
    std::uint32_t shape = 0;
    std::uint32_t first_part = 0;  ///< In parts().
    std::uint32_t count = 0;       ///< Of parts; kMeanBit if `inside` is the mean coverage.
    float inside = 0.0F;           ///< Winding number of an area around the cell's center.
  };

  InkGrid() = default;
  explicit InkGrid(std::span<const InkShape> shapes);

  bool empty() const { return levels_.empty(); }
  glm::vec2 origin_m() const { return low_m_; }
  std::span<const Level> levels() const { return levels_; }
  /// First entry and number of entries, one a cell.
  const std::vector<std::array<std::uint32_t, 2>>& cells() const { return cells_; }
  const std::vector<Entry>& entries() const { return entries_; }
  /// Indices of segments().
  const std::vector<std::uint32_t>& parts() const { return parts_; }
  /// Segments of lines and edges of areas.
  const std::vector<InkPart>& segments() const { return segments_; }

  /// A box seen from above that contains ink.
  struct Box {
    glm::vec2 low_m, high_m;
  };
  /// Boxes that together contain all ink but for what pens add by pixels; about 4,096 at most.
  std::vector<Box> Boxes() const;

 private:
  struct InCell {
    std::uint32_t cell;
    Entry entry;
  };
  void AddLevel(std::span<const InkShape> shapes, float cell_m);
  void FindCrowdedChildren(const Level& level);
  void AddLine(const InkShape& shape, std::uint32_t number, const Level& level,
               std::vector<InCell>* found);
  void AddArea(std::uint32_t number, const Level& level, std::vector<InCell>* found);
  void AddParts(std::uint32_t number, std::vector<std::uint64_t>* in_cells,
                std::vector<InCell>* found);
  void SortIntoCells(std::span<const InkShape> shapes, const Level& level,
                     const std::vector<InCell>& found);
  std::vector<Entry> MeansOf(std::span<const InkShape> shapes, const Level& level,
                             std::uint32_t cell, std::span<const Entry> listed) const;
  std::vector<Entry> MeansOfChildren(std::span<const InkShape> shapes, const Level& level,
                                     std::uint32_t cell) const;
  float MeanOfLine(const InkPen& pen, const Entry& entry, glm::vec2 low_m, float cell_m) const;
  float MeanOfArea(const Entry& entry, glm::vec2 low_m, float cell_m) const;

  glm::vec2 low_m_{0.0F}, high_m_{0.0F};
  std::vector<Level> levels_;
  std::vector<std::array<std::uint32_t, 2>> cells_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> parts_;
  std::vector<InkPart> segments_;
  std::vector<std::uint32_t> first_segments_;  // One a shape.
  std::vector<bool> crowded_;                  // Cells of the level that is added last.
};

}  // namespace pleinair::compositor
