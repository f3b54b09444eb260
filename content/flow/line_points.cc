#include "content/flow/line_points.h"

#include <algorithm>
#include <cmath>

namespace pleinair::content {

Result<LinePoints> LinePoints::Create(const Box& box, double cell_m) {
  LinePoints points;
  points.low_ = box.min;
  points.per_cell_ = 1.0 / cell_m;
  const Vec3 size = box.max - box.min;
  double cells = 1.0;
  const std::array<double, 3> extents{size.x, size.y, size.z};
  for (std::size_t a = 0; a < 3; ++a) {
    const double count = std::max(1.0, std::ceil(extents[a] / cell_m));
    cells *= count;
    if (!(cells <= static_cast<double>(kMaxCells))) {
      return InputError("", "the spacing is too small for the domain",
                        "use a larger spacing, or cut out the part that you need");
    }
    points.counts_[a] = static_cast<int>(count);
  }
  points.heads_.assign(static_cast<std::size_t>(cells), kNone);
  return points;
}

std::array<int, 3> LinePoints::CellOf(const Vec3& point) const {
  const auto cell = [this](double x, double low, int count) {
    return static_cast<int>(std::clamp((x - low) * per_cell_, 0.0, count - 1.0));
  };
  return {cell(point.x, low_.x, counts_[0]), cell(point.y, low_.y, counts_[1]),
          cell(point.z, low_.z, counts_[2])};
}

void LinePoints::Add(const Entry& entry) {
  const std::array<int, 3> cell = CellOf(entry.point);
  std::uint32_t& head = heads_[Number(cell[0], cell[1], cell[2])];
  next_.push_back(head);
  head = static_cast<std::uint32_t>(entries_.size());
  entries_.push_back(entry);
}

}  // namespace pleinair::content
