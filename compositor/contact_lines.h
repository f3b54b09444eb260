#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "compositor/mesh_orientation.h"

namespace pleinair::compositor {

/// The lines along which real surfaces meet so that they see each other: the foot of a wall, the
/// inner edge of a step. What one reflects onto the other, and hides from it, changes there within
/// a small part of the surfaces' size.
class ContactLines {
 public:
  /// Of the phantoms among `surfaces`, those of their triangles whose edges are longer than
  /// `finest_m`: what is finer needs no more vertices. Marker coordinates, metres.
  ContactLines(const std::vector<SurfaceMesh>& surfaces, double finest_m);

  struct Segment {
    Vec3 from, to;
  };
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
