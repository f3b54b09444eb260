#pragma once

// Internal: where even placement left holes.

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "base/error.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// The distance to the nearest point of a line, on a lattice of a quarter of the spacing.
class PlacementHoles {
 public:
  /// `has_flow`: whether a point of the lattice counts. Error (input, without a place): the spacing
  /// is too small for the domain.
  static Result<PlacementHoles> Create(const Box& box, double spacing_m, bool plane,
                                       const std::function<bool(const Vec3&)>& has_flow);

  /// A point of a line.
  void Add(const Vec3& point);
  /// The middle of the largest hole whose radius exceeds the spacing; each once.
  std::optional<Vec3> TakeLargest();

 private:
  Vec3 Node(std::size_t number) const;

  Vec3 low_;
  double spacing_m_ = 0.0, step_m_ = 0.0, radius_m_ = 0.0;
  std::array<int, 3> counts_{};
  std::vector<float> distance_m_;                               // 0: no hole.
  std::priority_queue<std::pair<float, std::size_t>> largest_;  // May be out of date.
  bool is_filled_ = false;
};

}  // namespace pleinair::content
