#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vector.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// The lines along which real surfaces meet so that they see each other: the foot of a wall, the
/// inner edge of a step. What one reflects onto the other, and hides from it, changes there within
/// a small part of the surfaces' size.
class ContactEdges {
 public:
  /// Longest edge that is fine enough about a point though surfaces meet there, metres.
  using EdgeLimit = std::function<double(const std::array<float, 3>& point)>;

  /// Without lines: nothing meets.
  ContactEdges() = default;
  /// Of the phantoms among `surfaces`. Of two triangles that meet, one at least has an edge longer
  /// than `edge_limit` at its middle: where both are finer nothing needs more vertices, as among a
  /// tree's leaves. Marker coordinates, metres.
  ///
  /// None at all where finding them would take long or they would be more than `kMaxSegments`:
  /// time and memory are bounded whatever the phantoms are. Which scenes those are depends on the
  /// surfaces alone, not on the machine.
  ContactEdges(const std::vector<SurfaceMesh>& surfaces, const EdgeLimit& edge_limit);

  static constexpr std::size_t kMaxSegments = 4'000;

  struct Segment {
    Vec3 from, to;
  };
  /// Each once, however many triangles lie on it.
  const std::vector<Segment>& segments() const { return segments_; }

  /// Whether a line lies within `reach_m` of a point.
  bool IsWithin(const std::array<float, 3>& point, double reach_m) const;

 private:
  /// Half of the segments below it each, or a few segments.
  struct Node {
    Vec3 low, high;
    std::uint32_t first = 0, last = 0;
    std::uint32_t children = 0;  ///< Index of the first of two; 0: none.
  };
  void Divide(std::uint32_t node);
  bool IsWithin(std::uint32_t node, Vec3 point, double reach_m) const;

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace pleinair::compositor
