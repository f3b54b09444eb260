#pragma once

#include <array>
#include <vector>

#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// How far points are from the nearest virtual object: from the box around each of its surfaces, or
/// from the one around them all where there are very many. From the marker where there is none.
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
