#include "content/flow/level_grid.h"

#include <algorithm>

namespace pleinair::content {
namespace {

GridAxis AxisOver(double low_m, double high_m, double cell_m) {
  const int cells = static_cast<int>(std::lround((high_m - low_m) / cell_m));
  return cells < 1 ? GridAxis(low_m, 1.0, 1) : GridAxis(low_m, (high_m - low_m) / cells, cells + 1);
}

}  // namespace

LevelGrid::LevelGrid(const VectorField& field) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid != nullptr && grid->grid().cells.empty()) {
    axes_ = grid->grid().axes;
  } else {
    const Box box = field.bounds();
    const double cell_m = field.cell_m();
    axes_ = {AxisOver(box.min.x, box.max.x, cell_m), AxisOver(box.min.y, box.max.y, cell_m),
             AxisOver(box.min.z, box.max.z, cell_m)};
    // The cells of a grid in the plane have no height.
    if (grid != nullptr && grid->axes().size() == 2) axes_[2] = GridAxis(box.min.z, 1.0, 1);
  }
  for (const GridAxis& axis : axes_) dimensions_ += axis.flat() ? 0 : 1;
}

std::size_t LevelGrid::nodes() const {
  return static_cast<std::size_t>(axes_[0].count()) * static_cast<std::size_t>(axes_[1].count()) *
         static_cast<std::size_t>(axes_[2].count());
}

Vec3 LevelGrid::Node(std::size_t number) const {
  const auto n0 = static_cast<std::size_t>(axes_[0].count());
  const auto n1 = static_cast<std::size_t>(axes_[1].count());
  return {axes_[0].Node(static_cast<int>(number % n0)),
          axes_[1].Node(static_cast<int>(number / n0 % n1)),
          axes_[2].Node(static_cast<int>(number / n0 / n1))};
}

LevelGrid::Place LevelGrid::Find(const Vec3& point) const {
  Place place;
  const std::array<double, 3> x{point.x, point.y, point.z};
  place.inside = true;
  for (std::size_t a = 0; a < 3; ++a) {
    const GridAxis::Place found = axes_[a].Find(x[a], 0);
    place.index[a] = found.index;
    place.fraction[a] = found.fraction;
    place.inside = place.inside && axes_[a].Contains(x[a]);
  }
  return place;
}

LevelGrid::Nearest LevelGrid::NearestTo(const Vec3& point) const {
  const Place place = Find(point);
  std::array<int, 3> node{};
  Nearest nearest{0, true};
  for (std::size_t a = 0; a < 3; ++a) {
    if (axes_[a].flat()) continue;
    const double rounded = std::floor(place.fraction[a] + 0.5);
    node[a] = place.index[a] + static_cast<int>(rounded);
    const int last = axes_[a].count() - 1;
    // Half a cell beyond the border still belongs to the border's nodes.
    if (!(node[a] >= 0 && node[a] <= last)) nearest.inside = false;
    node[a] = std::clamp(node[a], 0, last);
  }
  nearest.node = Number(node[0], node[1], node[2]);
  return nearest;
}

}  // namespace pleinair::content
