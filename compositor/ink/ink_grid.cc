#include "compositor/ink/ink_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "gl/glsl_as_cpp.h"

namespace pleinair::compositor {
namespace {

namespace glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): as GLSL has it.
#include "compositor/shaders/winding.glsl"
}  // namespace glsl

constexpr std::size_t kMinCells = 256, kMaxCells = std::size_t{1} << 20;
constexpr float kCellsPerSegment = 2.0F, kMaxCellsAlong = 4096.0F, kMinCell_m = 0.02F;
constexpr int kMostTopCells = 2;  // Along each side of the coarsest level.
constexpr int kMostBoxesAlong = 64;
constexpr int kPlacesOfMean = 4;  // Along each side of a cell.

/// A range of cells, both ends included.
struct CellRange {
  glm::ivec2 first, last;
};

CellRange RangeOf(const InkGrid::Level& level, glm::vec2 origin_m, glm::vec2 low_m,
                  glm::vec2 high_m) {
  const auto cell_of = [&](glm::vec2 at) {
    const glm::vec2 cell = glm::floor((at - origin_m) / level.cell_m);
    return glm::ivec2(glm::clamp(cell, glm::vec2(0.0F), glm::vec2(level.cells - 1)));
  };
  return {cell_of(low_m), cell_of(high_m)};
}

std::size_t IndexOf(glm::ivec2 cells, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.x) +
         static_cast<std::size_t>(x);
}

/// Distance of a segment to a point, squared.
float DistanceSquared(glm::vec2 from, glm::vec2 to, glm::vec2 at) {
  const glm::vec2 whole = to - from;
  const float size = glm::dot(whole, whole);
  const float share =
      size > 0.0F ? glm::clamp(glm::dot(at - from, whole) / size, 0.0F, 1.0F) : 0.0F;
  const glm::vec2 away = at - from - share * whole;
  return glm::dot(away, away);
}

/// Length of a segment's part in a box.
float LengthWithin(glm::vec2 from, glm::vec2 to, glm::vec2 low, glm::vec2 high) {
  float begin = 0.0F, end = 1.0F;
  for (int axis = 0; axis < 2; ++axis) {
    const float way = to[axis] - from[axis];
    if (std::fabs(way) < 1e-12F) {
      if (from[axis] < low[axis] || from[axis] >= high[axis]) return 0.0F;
      continue;
    }
    const float a = (low[axis] - from[axis]) / way, b = (high[axis] - from[axis]) / way;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return std::max(end - begin, 0.0F) * glm::length(to - from);
}

/// Keeps the shapes with the largest coverage.
void KeepLargest(std::vector<InkGrid::Entry>* means) {
  if (means->size() <= InkGrid::kMaxShapes) return;
  const auto middle = means->begin() + InkGrid::kMaxShapes;
  std::nth_element(means->begin(), middle, means->end(),
                   [](const auto& a, const auto& b) { return a.inside > b.inside; });
  means->erase(middle, means->end());
  std::sort(means->begin(), means->end(),
            [](const auto& a, const auto& b) { return a.shape < b.shape; });
}

}  // namespace

InkGrid::InkGrid(std::span<const InkShape> shapes) {
  glm::vec2 low(std::numeric_limits<float>::max()), high = -low;
  for (const InkShape& shape : shapes) {
    first_segments_.push_back(static_cast<std::uint32_t>(segments_.size()));
    const float half_width_m = 0.5F * shape.pen.width_m;
    const auto add = [&](const InkPart& part) {
      segments_.push_back(part);
      low = glm::min(low, glm::min(glm::vec2(part.from), glm::vec2(part.to)) - half_width_m);
      high = glm::max(high, glm::max(glm::vec2(part.from), glm::vec2(part.to)) + half_width_m);
    };
    for (const InkPart& part : PartsOfLine(shape.segments, half_width_m)) add(part);
    for (const auto& ring : shape.rings) {
      for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
        add({glm::vec4(ring[i], 0.0F, 0.0F), glm::vec4(ring[i + 1], 0.0F, 0.0F)});
      }
    }
  }
  first_segments_.push_back(static_cast<std::uint32_t>(segments_.size()));
  if (segments_.empty()) return;
  low_m_ = low;
  high_m_ = high;
  const glm::vec2 size_m = high - low;
  const float wanted = std::clamp(kCellsPerSegment * static_cast<float>(segments_.size()),
                                  static_cast<float>(kMinCells), static_cast<float>(kMaxCells));
  float cell_m = std::max({std::sqrt(size_m.x * size_m.y / wanted),
                           std::max(size_m.x, size_m.y) / kMaxCellsAlong, kMinCell_m});
  for (;; cell_m *= 2.0F) {
    AddLevel(shapes, cell_m);
    const glm::ivec2 cells = levels_.back().cells;
    if (std::max(cells.x, cells.y) <= kMostTopCells) break;
  }
}

void InkGrid::AddLevel(std::span<const InkShape> shapes, float cell_m) {
  const Level level{
      .cell_m = cell_m,
      .cells = glm::max(glm::ivec2(glm::ceil((high_m_ - low_m_) / cell_m)), glm::ivec2(1)),
      .first_cell = static_cast<std::uint32_t>(cells_.size())};
  FindCrowdedChildren(level);
  std::vector<InCell> found;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    if (shapes[i].rings.empty()) {
      AddLine(shapes[i], number, level, &found);
    } else {
      AddArea(number, level, &found);
    }
  }
  SortIntoCells(shapes, level, found);
  levels_.push_back(level);
}

/// Marks the cells of a new level whose lists would be longer than those of a crowded cell below.
void InkGrid::FindCrowdedChildren(const Level& level) {
  std::vector<bool> crowded(
      static_cast<std::size_t>(level.cells.x) * static_cast<std::size_t>(level.cells.y), false);
  if (!levels_.empty()) {
    const glm::ivec2 cells = levels_.back().cells;
    for (int y = 0; y < cells.y; ++y) {
      for (int x = 0; x < cells.x; ++x) {
        if (crowded_[IndexOf(cells, x, y)]) {
          crowded[IndexOf(level.cells, x / 2, y / 2)] = true;
        }
      }
    }
  }
  crowded_ = std::move(crowded);
}

/// Adds a shape's parts, cell by cell. `in_cells`: the cell above the part's number.
void InkGrid::AddParts(std::uint32_t number, std::vector<std::uint64_t>* in_cells,
                       std::vector<InCell>* found) {
  std::sort(in_cells->begin(), in_cells->end());
  for (std::size_t i = 0; i < in_cells->size();) {
    const auto cell = static_cast<std::uint32_t>((*in_cells)[i] >> 32);
    InCell in_cell{cell, {number, static_cast<std::uint32_t>(parts_.size()), 0, 0.0F}};
    for (; i < in_cells->size() && (*in_cells)[i] >> 32 == cell; ++i) {
      parts_.push_back(static_cast<std::uint32_t>((*in_cells)[i] & 0xFFFFFFFFU));
      ++in_cell.entry.count;
    }
    found->push_back(in_cell);
  }
}

void InkGrid::AddLine(const InkShape& shape, std::uint32_t number, const Level& level,
                      std::vector<InCell>* found) {
  std::vector<std::uint64_t> in_cells;
  const float margin_m = 0.5F * level.cell_m + 0.5F * shape.pen.width_m;
  const float reach_m = margin_m + std::sqrt(0.5F) * level.cell_m;
  for (std::uint32_t i = first_segments_[number]; i < first_segments_[number + 1]; ++i) {
    const glm::vec2 from(segments_[i].from), to(segments_[i].to);
    const CellRange range =
        RangeOf(level, low_m_, glm::min(from, to) - margin_m, glm::max(from, to) + margin_m);
    for (int y = range.first.y; y <= range.last.y; ++y) {
      for (int x = range.first.x; x <= range.last.x; ++x) {
        if (crowded_[IndexOf(level.cells, x, y)]) continue;
        const glm::vec2 center = low_m_ + level.cell_m * (glm::vec2(x, y) + 0.5F);
        if (DistanceSquared(from, to, center) > reach_m * reach_m) continue;
        in_cells.push_back(static_cast<std::uint64_t>(y * level.cells.x + x) << 32 | i);
      }
    }
  }
  AddParts(number, &in_cells, found);
}

void InkGrid::AddArea(std::uint32_t number, const Level& level, std::vector<InCell>* found) {
  const std::size_t first_found = found->size();
  AddLine({}, number, level, found);  // The edges, which have no width.
  glm::vec2 low(std::numeric_limits<float>::max()), high = -low;
  for (std::uint32_t i = first_segments_[number]; i < first_segments_[number + 1]; ++i) {
    low = glm::min(low, glm::vec2(segments_[i].from));
    high = glm::max(high, glm::vec2(segments_[i].from));
  }
  const CellRange range = RangeOf(level, low_m_, low - level.cell_m, high + level.cell_m);
  // Winding numbers along a row change where it crosses edges.
  std::vector<std::vector<std::pair<float, float>>> crossings(
      static_cast<std::size_t>(range.last.y - range.first.y + 1));
  for (std::uint32_t i = first_segments_[number]; i < first_segments_[number + 1]; ++i) {
    const glm::vec2 from(segments_[i].from), to(segments_[i].to);
    if (from.y == to.y) continue;
    const CellRange rows = RangeOf(level, low_m_, glm::min(from, to), glm::max(from, to));
    for (int y = rows.first.y; y <= rows.last.y; ++y) {
      const float center_y = low_m_.y + level.cell_m * (static_cast<float>(y) + 0.5F);
      if ((from.y <= center_y) == (to.y <= center_y)) continue;
      crossings[static_cast<std::size_t>(y - range.first.y)].emplace_back(
          from.x + (center_y - from.y) / (to.y - from.y) * (to.x - from.x),
          to.y > from.y ? -1.0F : 1.0F);
    }
  }
  std::vector<InCell> merged;
  auto with_edges = found->begin() + static_cast<std::ptrdiff_t>(first_found);
  for (int y = range.first.y; y <= range.last.y; ++y) {
    auto& row = crossings[static_cast<std::size_t>(y - range.first.y)];
    std::sort(row.begin(), row.end());
    auto next = row.begin();
    float winding = 0.0F;
    for (int x = range.first.x; x <= range.last.x; ++x) {
      const float center_x = low_m_.x + level.cell_m * (static_cast<float>(x) + 0.5F);
      for (; next != row.end() && next->first <= center_x; ++next) winding += next->second;
      const auto cell = static_cast<std::uint32_t>(y * level.cells.x + x);
      InCell in_cell{cell, {number, 0, 0, 0.0F}};
      const bool has_edges = with_edges != found->end() && with_edges->cell == cell;
      if (has_edges) in_cell = *with_edges++;
      in_cell.entry.inside = winding;
      if (has_edges || (winding != 0.0F && !crowded_[cell])) merged.push_back(in_cell);
    }
  }
  found->resize(first_found);
  found->insert(found->end(), merged.begin(), merged.end());
}

/// Sorts the entries by cell; within one, shapes keep their order.
void InkGrid::SortIntoCells(std::span<const InkShape> shapes, const Level& level,
                            const std::vector<InCell>& found) {
  std::vector<std::uint32_t> starts(crowded_.size() + 1, 0);
  for (const InCell& in_cell : found) ++starts[in_cell.cell + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Entry> sorted(found.size());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for (const InCell& in_cell : found) sorted[next[in_cell.cell]++] = in_cell.entry;
  cells_.resize(level.first_cell + crowded_.size(), {0, 0});
  for (std::uint32_t cell = 0; cell < crowded_.size(); ++cell) {
    std::vector<Entry> listed(sorted.begin() + starts[cell], sorted.begin() + starts[cell + 1]);
    std::size_t parts = 0;
    for (const Entry& entry : listed) parts += entry.count;
    crowded_[cell] = crowded_[cell] || parts > kMaxParts || listed.size() > kMaxParts;
    if (crowded_[cell]) {
      listed = levels_.empty() ? MeansOf(shapes, level, cell, listed)
                               : MeansOfChildren(shapes, level, cell);
      KeepLargest(&listed);
    }
    cells_[level.first_cell + cell] = {static_cast<std::uint32_t>(entries_.size()),
                                       static_cast<std::uint32_t>(listed.size())};
    entries_.insert(entries_.end(), listed.begin(), listed.end());
  }
}

/// Mean coverages of the shapes that a cell lists.
std::vector<InkGrid::Entry> InkGrid::MeansOf(std::span<const InkShape> shapes, const Level& level,
                                             std::uint32_t cell,
                                             std::span<const Entry> listed) const {
  const auto width = static_cast<std::uint32_t>(level.cells.x);
  const glm::vec2 low = low_m_ + level.cell_m * glm::vec2(cell % width, cell / width);
  std::vector<Entry> means;
  for (const Entry& entry : listed) {
    const InkShape& shape = shapes[entry.shape];
    float covered = entry.inside;
    if ((entry.count & kMeanBit) == 0) {
      covered = shape.rings.empty() ? MeanOfLine(shape.pen, entry, low, level.cell_m)
                                    : MeanOfArea(entry, low, level.cell_m);
    }
    if (covered > 0.0F) means.push_back({entry.shape, 0, kMeanBit, std::min(covered, 1.0F)});
  }
  return means;
}

/// Mean coverages of a cell, from those of the four cells below.
std::vector<InkGrid::Entry> InkGrid::MeansOfChildren(std::span<const InkShape> shapes,
                                                     const Level& level, std::uint32_t cell) const {
  const Level& below = levels_.back();
  const glm::ivec2 first(2 * (static_cast<int>(cell) % level.cells.x),
                         2 * (static_cast<int>(cell) / level.cells.x));
  std::vector<Entry> means;
  for (int child = 0; child < 4; ++child) {
    const glm::ivec2 at = first + glm::ivec2(child % 2, child / 2);
    if (at.x >= below.cells.x || at.y >= below.cells.y) continue;
    const auto number = static_cast<std::uint32_t>(at.y * below.cells.x + at.x);
    const auto [begin, count] = cells_[below.first_cell + number];
    for (Entry mean : MeansOf(shapes, below, number, std::span(entries_).subspan(begin, count))) {
      mean.inside *= 0.25F;
      means.push_back(mean);
    }
  }
  std::sort(means.begin(), means.end(),
            [](const Entry& a, const Entry& b) { return a.shape < b.shape; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (kept > 0 && means[kept - 1].shape == means[i].shape) {
      means[kept - 1].inside += means[i].inside;
    } else {
      means[kept++] = means[i];
    }
  }
  means.resize(kept);
  return means;
}

/// Share of a cell that a line covers.
float InkGrid::MeanOfLine(const InkPen& pen, const Entry& entry, glm::vec2 low_m,
                          float cell_m) const {
  float length_m = 0.0F;
  for (std::uint32_t p = entry.first_part; p < entry.first_part + entry.count; ++p) {
    const InkPart& segment = segments_[parts_[p]];
    length_m += LengthWithin(glm::vec2(segment.from), glm::vec2(segment.to), low_m, low_m + cell_m);
  }
  // Footprints that take means of a level have about half a cell.
  const float width_m = pen.width_m > 0.0F ? pen.width_m : 0.5F * cell_m * pen.width_px;
  const float drawn = pen.gap_m > 0.0F ? pen.dash_m / (pen.dash_m + pen.gap_m) : 1.0F;
  return drawn * width_m * length_m / (cell_m * cell_m);
}

/// Share of a cell that an area covers, from its winding numbers at places.
float InkGrid::MeanOfArea(const Entry& entry, glm::vec2 low_m, float cell_m) const {
  const glm::vec2 center = low_m + 0.5F * cell_m;
  float covered = 0.0F;
  for (int i = 0; i < kPlacesOfMean * kPlacesOfMean; ++i) {
    const int column = i % kPlacesOfMean, row = i / kPlacesOfMean;
    const glm::vec2 place = glm::vec2(column, row) + 0.5F;
    float winding = entry.inside;
    for (std::uint32_t p = entry.first_part; p < entry.first_part + entry.count; ++p) {
      const InkPart& edge = segments_[parts_[p]];
      winding += glsl::CrossingOfEdge(center, low_m + cell_m / kPlacesOfMean * place,
                                      glm::vec2(edge.from), glm::vec2(edge.to));
    }
    covered += std::min(std::fabs(winding), 1.0F);
  }
  return covered / (kPlacesOfMean * kPlacesOfMean);
}

std::vector<InkGrid::Box> InkGrid::Boxes() const {
  std::vector<Box> boxes;
  for (const Level& level : levels_) {
    if (std::max(level.cells.x, level.cells.y) > kMostBoxesAlong) continue;
    for (int y = 0; y < level.cells.y; ++y) {
      for (int x = 0; x < level.cells.x; ++x) {
        const auto cell = static_cast<std::uint32_t>(y * level.cells.x + x);
        if (cells_[level.first_cell + cell][1] == 0) continue;
        const glm::vec2 low = low_m_ + level.cell_m * glm::vec2(x, y);
        boxes.push_back({low, low + level.cell_m});
      }
    }
    return boxes;
  }
  return boxes;
}

}  // namespace pleinair::compositor
