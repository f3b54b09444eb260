#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vector.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// The contact edges of real surfaces: curves along which two surfaces meet and see each other.
/// Examples are the foot of a wall and the inner edge of a step. Near these edges, interreflection
/// and occlusion change within a small part of the surfaces' size.
class ContactEdges {
 public:
  /// Longest edge, in metres, that is fine enough at a point even if surfaces meet there.
  using EdgeLimit = std::function<double(const std::array<float, 3>& point)>;

  /// Makes an empty set: no surfaces meet.
  ContactEdges() = default;
  /// Finds the contact edges of the phantoms among `surfaces`, in marker coordinates, metres. At
  /// least one of two meeting triangles must have an edge longer than `edge_limit` at its midpoint.
  /// Finer pairs, as among a tree's leaves, need no more vertices.
  ///
  /// The set is empty if the search would take long or find more than `kMaxSegments` edges. Time
  /// and memory are therefore bounded for all phantoms. This limit depends on the surfaces alone,
  /// not on the machine.
  ContactEdges(const std::vector<SurfaceMesh>& surfaces, const EdgeLimit& edge_limit);

  static constexpr std::size_t kMaxSegments = 4'000;

  struct Segment {
    Vec3 from, to;
  };
  /// Each segment appears once, however many triangles share it.
  const std::vector<Segment>& segments() const { return segments_; }

  /// Returns whether a contact edge lies within `reach_m` of a point.
  bool IsWithin(const std::array<float, 3>& point, double reach_m) const;

 private:
  /// An inner node has two children with half of its segments each; a leaf has a few segments.
  struct Node {
    Vec3 low, high;
    std::uint32_t first = 0, last = 0;
    std::uint32_t children = 0;  ///< Index of the first of two children; 0: none.
  };
  void Divide(std::uint32_t node);
  bool IsWithin(std::uint32_t node, Vec3 point, double reach_m) const;

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace pleinair::compositor
