#include "content/flow/grid_axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pleinair::content {
namespace {

constexpr double kUniformWithin = 1e-5;      // Of the distance of nodes.
constexpr double kSinglePrecision = 1.2e-7;  // Of the coordinate, where files store floats.
constexpr double kSlack = 1e-10;             // Of the length of the axis.

bool IsUniform(const std::vector<double>& nodes, double step) {
  const double magnitude = std::max(std::fabs(nodes.front()), std::fabs(nodes.back()));
  const double allowed =
      std::max(kUniformWithin * step, std::min(kSinglePrecision * magnitude, 0.01 * step));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (std::fabs(nodes[i] - (nodes.front() + step * static_cast<double>(i))) > allowed)
      return false;
  }
  return true;
}

}  // namespace

GridAxis::GridAxis(double first_m, double step_m, int count)
    : origin_m_(first_m),
      step_m_(step_m),
      per_step_(1.0 / step_m),
      count_(count),
      first_m_(first_m),
      last_m_(first_m + step_m * (count - 1)),
      slack_m_(kSlack * step_m * std::max(1, count - 1)),
      min_step_m_(step_m) {}

GridAxis::GridAxis(std::vector<double> nodes_m)
    : GridAxis(nodes_m.front(),
               nodes_m.size() > 1
                   ? (nodes_m.back() - nodes_m.front()) / static_cast<double>(nodes_m.size() - 1)
                   : 1.0,
               static_cast<int>(nodes_m.size())) {
  if (nodes_m.size() < 3 || IsUniform(nodes_m, step_m_)) return;
  nodes_m_ = std::move(nodes_m);
  for (int i = 0; i + 1 < count_; ++i) min_step_m_ = std::min(min_step_m_, Step(i));
}

GridAxis GridAxis::Closed(double first_m, double step_m, int count) {
  GridAxis axis(first_m, step_m, count);
  axis.origin_m_ -= kNodesBefore * step_m;
  axis.count_ += kNodesBefore + kNodesAfter;
  axis.period_m_ = step_m * count;
  axis.last_m_ = first_m + axis.period_m_;
  return axis;
}

double GridAxis::Turned(double x_m) const {
  return x_m - period_m_ * std::floor((x_m - first_m_) / period_m_);
}

GridAxis::Place GridAxis::FindBetweenNodes(double x_m, int hint) const {
  const int last = count_ - 2;
  int index = std::clamp(hint, 0, last);
  const auto node = [this](int i) { return nodes_m_[static_cast<std::size_t>(i)]; };
  if (x_m < node(index) || x_m >= node(index + 1)) {
    const auto above = std::upper_bound(nodes_m_.begin(), nodes_m_.end(), x_m);
    index = std::clamp(static_cast<int>(above - nodes_m_.begin()) - 1, 0, last);
  }
  return {index, (x_m - node(index)) / (node(index + 1) - node(index))};
}

}  // namespace pleinair::content
