#include "content/flow/grid_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "content/flow/field_probe.h"

namespace pleinair::content {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

std::vector<int> AxesOf(const StructuredGrid& grid) {
  std::vector<int> axes;
  for (int a = 0; a < 3; ++a) {
    if (!grid.axes[static_cast<std::size_t>(a)].flat()) axes.push_back(a);
  }
  for (int a = 0; axes.size() < 2 && a < 3; ++a) {
    if (grid.axes[static_cast<std::size_t>(a)].flat()) axes.push_back(a);
  }
  std::sort(axes.begin(), axes.end());
  return axes;
}

}  // namespace

GridField::GridField(StructuredGrid grid, std::vector<Seconds> times, FieldSlices::Read slices,
                     GridFieldOptions options)
    : grid_(std::move(grid)),
      times_(std::move(times)),
      options_(std::move(options)),
      axes_(AxesOf(grid_)),
      cell_m_(grid_.MinCell()),
      slices_(std::move(slices)) {}

Result<std::shared_ptr<const GridField>> GridField::Create(StructuredGrid grid,
                                                           std::vector<Seconds> times,
                                                           FieldSlices::Read slices,
                                                           GridFieldOptions options) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (!(times[i] > times[i - 1])) {
      return InputError(
          "",
          "its times do not ascend: time " + std::to_string(i + 1) + " is not after the one before",
          "sort the times of the file");
    }
  }
  if (!std::isfinite(grid.MinCell())) {
    return InputError("", "the grid has a single point", "give at least two points along an axis");
  }
  return std::shared_ptr<const GridField>(
      new GridField(std::move(grid), std::move(times), std::move(slices), std::move(options)));
}

Result<FieldWindow> GridField::WindowAt(Seconds time, bool backward) const {
  FieldWindow window;
  if (times_.size() < 2 || time <= times_.front() || time >= times_.back()) {
    const bool at_start = times_.size() > 1 && time == times_.front() && !backward;
    const bool at_end = times_.size() > 1 && time == times_.back() && backward;
    if (!at_start && !at_end) {
      const bool before = times_.size() < 2 || time <= times_.front();
      PLEINAIR_ASSIGN_OR_RETURN(window.first, slices_.At(before ? 0 : times_.size() - 1));
      return window;
    }
  }
  const auto after = backward ? std::lower_bound(times_.begin(), times_.end(), time)
                              : std::upper_bound(times_.begin(), times_.end(), time);
  const auto second = static_cast<std::size_t>(after - times_.begin());
  PLEINAIR_ASSIGN_OR_RETURN(window.first, slices_.At(second - 1));
  PLEINAIR_ASSIGN_OR_RETURN(window.second, slices_.At(second));
  window.first_s = times_[second - 1];
  window.second_s = times_[second];
  return window;
}

Result<FieldWindow> GridField::FrozenAt(Seconds time) const {
  PLEINAIR_ASSIGN_OR_RETURN(FieldWindow window, WindowAt(time));
  if (!window.second) return window;
  const double weight = window.WeightAt(time);
  if (weight == 0.0) return FieldWindow{.first = window.first, .second = nullptr};
  return FieldWindow{
      .first = std::make_shared<const FieldSlice>(Blend(*window.first, *window.second, weight)),
      .second = nullptr};
}

Velocity GridField::At(const Vec3& point, Seconds time) const {
  const auto window = WindowAt(time);
  const Velocity none{kNotANumber, kNotANumber, kNotANumber};
  if (!window) return none;
  Velocity velocity;
  const auto probe = MakeProbe(*this, *window);
  return probe->Sample(point, time, &velocity) == PointState::kFlow ? velocity : none;
}

}  // namespace pleinair::content
