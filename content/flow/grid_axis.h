#pragma once

#include <cstddef>
#include <vector>

namespace pleinair::content {

/// Coordinates of a grid's nodes along one axis, ascending, metres. One node: the axis is flat, and
/// velocities along it count as zero.
class GridAxis {
 public:
  /// Where a coordinate lies: between nodes `index` and `index` + 1. The fraction exceeds [0, 1]
  /// only outside the axis.
  struct Place {
    int index = 0;
    double fraction = 0.0;
  };

  GridAxis() : GridAxis(0.0, 1.0, 1) {}
  GridAxis(double first_m, double step_m, int count);
  /// Needs finite, ascending nodes. Nodes at equal distances, within 1e-5 of these, count as
  /// uniform. Coordinates that are stored in single precision may deviate by their rounding.
  explicit GridAxis(std::vector<double> nodes_m);

  /// A closed axis, as that of all longitudes: the node after the last is the first again. Uniform
  /// axes only. Grids repeat one node before and two after (kNodesBefore, kNodesAfter), so that
  /// each stencil finds its values in a row.
  static GridAxis Closed(double first_m, double step_m, int count);
  static constexpr int kNodesBefore = 1, kNodesAfter = 2;

  int count() const { return count_; }  ///< With the repeated nodes.
  bool flat() const { return count_ == 1; }
  bool closed() const { return period_m_ > 0.0; }
  bool uniform() const { return nodes_m_.empty(); }
  double period_m() const { return period_m_; }
  double first_m() const { return first_m_; }
  double last_m() const { return last_m_; }
  double Node(int index) const {
    return uniform() ? origin_m_ + step_m_ * index : nodes_m_[static_cast<std::size_t>(index)];
  }
  /// Distance of the nodes `index` and `index` + 1; of a flat axis 1.
  double Step(int index) const {
    return uniform() ? step_m_
                     : nodes_m_[static_cast<std::size_t>(index) + 1] -
                           nodes_m_[static_cast<std::size_t>(index)];
  }
  double min_step_m() const { return min_step_m_; }

  /// `hint`: an index near the result, for speed.
  Place Find(double x_m, int hint) const {
    if (flat()) return {};
    if (closed()) x_m = Wrapped(x_m);
    if (!uniform()) return FindBetweenNodes(x_m, hint);
    const double place = (x_m - origin_m_) * per_step_;
    const int last = count_ - 2;
    int index = place > 0.0 ? (place < last ? static_cast<int>(place) : last) : 0;
    return {index, place - index};
  }

  /// Whether a coordinate lies on the axis. Borders belong to it, with 1e-10 of its length.
  bool Contains(double x_m) const {
    return closed() || flat() || (x_m >= first_m_ - slack_m_ && x_m <= last_m_ + slack_m_);
  }

  /// The coordinate on a closed axis; else unchanged.
  double Wrapped(double x_m) const {
    return !closed() || (x_m >= first_m_ && x_m < last_m_) ? x_m : Turned(x_m);
  }

 private:
  Place FindBetweenNodes(double x_m, int hint) const;
  double Turned(double x_m) const;

  double origin_m_ = 0.0, step_m_ = 1.0, per_step_ = 1.0;
  int count_ = 1;
  std::vector<double> nodes_m_;
  double first_m_ = 0.0, last_m_ = 0.0, slack_m_ = 0.0, period_m_ = 0.0, min_step_m_ = 1.0;
};

}  // namespace pleinair::content
