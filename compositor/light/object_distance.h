#pragma once

#include <array>
#include <vector>

#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Distance of points to the nearest virtual object, measured to the bounding box of each of its
/// surfaces. If there are more than 32 boxes, one box around them all replaces them. Without
/// virtual objects, the distance is to the marker.
class ObjectDistance {
 public:
  explicit ObjectDistance(const std::vector<SurfaceMesh>& surfaces);

  /// Metres; 0 within a box.
  double operator()(const std::array<float, 3>& point) const;

 private:
  struct Box {
    std::array<float, 3> low{}, high{};

    void Add(const std::array<float, 3>& point);
  };

  std::vector<Box> boxes_;
};

}  // namespace pleinair::compositor
