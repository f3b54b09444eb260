#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/error.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Points of lines in a hash grid, for distances between lines.
class LinePoints {
 public:
  struct Entry {
    Vec3 point;
    std::uint32_t line = 0;
    float arc_m = 0.0F;  ///< Along the line, from its seed.
  };

  /// Cells of `cell_m` over a box. Error (input, without a place): more than kMaxCells.
  static Result<LinePoints> Create(const Box& box, double cell_m);

  void Add(const Entry& entry);
  std::size_t size() const { return entries_.size(); }
  const Entry& operator[](std::size_t number) const { return entries_[number]; }

  /// Calls `visit(entry, distance²)` for points nearer than `radius_m` until it returns true;
  /// returns whether it did. The radius is at most the cell.
  template <typename Visit>
  bool AnyNear(const Vec3& point, double radius_m, const Visit& visit) const {
    const std::array<int, 3> low =
        CellOf({point.x - radius_m, point.y - radius_m, point.z - radius_m});
    const std::array<int, 3> high =
        CellOf({point.x + radius_m, point.y + radius_m, point.z + radius_m});
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          for (std::uint32_t n = heads_[Number(x, y, z)]; n != kNone; n = next_[n]) {
            const Vec3 off = entries_[n].point - point;
            const double square = Dot(off, off);
            if (square < radius_m * radius_m && visit(entries_[n], square)) return true;
          }
        }
      }
    }
    return false;
  }

  static constexpr std::size_t kMaxCells = std::size_t{1} << 27;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::array<int, 3> CellOf(const Vec3& point) const;
  std::size_t Number(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(counts_[0]) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(z));
  }

  Vec3 low_;
  double per_cell_ = 1.0;
  std::array<int, 3> counts_{};
  std::vector<std::uint32_t> heads_, next_;  // Lists of the entries of each cell.
  std::vector<Entry> entries_;
};

}  // namespace pleinair::content
