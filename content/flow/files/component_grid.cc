#include "content/flow/files/component_grid.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pleinair::content {

ComponentGrid::ComponentGrid(std::array<FieldAxis, 3> axes, std::array<std::size_t, 3> strides,
                             CurvilinearCells cells, FieldChart chart)
    : strides_(strides), chart_(std::move(chart)) {
  for (std::size_t a = 0; a < 3; ++a) {
    grid_.axes[a] = std::move(axes[a].axis);
    source_[a] = std::move(axes[a].source);
  }
  grid_.cells = std::move(cells);
}

FieldSlice ComponentGrid::Combine(const std::array<const std::vector<double>*, 3>& components,
                                  bool in_double) const {
  const std::array<int, 3> n = grid_.counts();
  std::array<bool, 3> used{n[0] > 1, n[1] > 1, n[2] > 1};
  for (std::size_t a = 0; a < 3 && used[0] + used[1] + used[2] < 2; ++a) used[a] = true;
  const std::size_t count = grid_.nodes() * (used[0] + used[1] + used[2] > 2 ? 3 : 2);
  FieldSlice slice;
  if (in_double) {
    slice.doubles.reserve(count);
  } else {
    slice.singles.reserve(count);
  }
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      Vec3 stretch = chart_.Stretch(grid_.Node(0, j, k));
      for (int i = 0; i < n[0]; ++i) {
        std::size_t at = 0;
        const std::array<int, 3> node{i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          at +=
              strides_[a] * static_cast<std::size_t>(source_[a][static_cast<std::size_t>(node[a])]);
        }
        const auto value = [&](std::size_t c) {
          return components[c] != nullptr ? (*components[c])[at] : 0.0;
        };
        Vec2 horizontal{value(0), value(1)};
        if (convergence_) {
          const Vec3 place = grid_.Node(i, j, k);
          horizontal = convergence_->Turned({place.x, place.y}, horizontal);
        }
        if (!grid_.cells.empty()) stretch = chart_.Stretch(grid_.Node(i, j, k));
        std::array<double, 3> v{horizontal.x * stretch.x, horizontal.y * stretch.y,
                                value(2) * stretch.z};
        // One missing component makes a wall.
        if (std::isnan(v[0] + v[1] + v[2])) v.fill(std::numeric_limits<double>::quiet_NaN());
        for (std::size_t a = 0; a < 3; ++a) {
          if (!used[a]) continue;
          if (in_double) {
            slice.doubles.push_back(v[a]);
          } else {
            slice.singles.push_back(static_cast<float>(v[a]));
          }
        }
      }
    }
  }
  return slice;
}

Result<FlowFile> MakeFlowFile(std::shared_ptr<const ComponentGrid> components,
                              std::vector<Seconds> times, FieldSlices::Read slices,
                              const FieldChart& chart, const FlowFileOptions& options) {
  const std::size_t nodes = components->grid().nodes();
  if (nodes > kMaxFieldNodes) {
    return InputError("", "has " + std::to_string(nodes) + " points at a time",
                      "cut out what lies near the marker: at most " +
                          std::to_string(kMaxFieldNodes) + " are read");
  }
  GridFieldOptions field_options;
  field_options.interpolation = options.interpolation;
  if (chart.kind() == ChartKind::kGeographic) {
    field_options.stretch = [chart](const Vec3& point) { return chart.Stretch(point); };
  }
  FlowFile file;
  PLEINAIR_ASSIGN_OR_RETURN(
      file.field, GridField::Create(components->grid(), std::move(times), std::move(slices),
                                    std::move(field_options)));
  file.chart = chart;
  file.has_heights = components->grid().counts()[2] > 1;
  return file;
}

}  // namespace pleinair::content
