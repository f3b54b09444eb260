#include "scene/marker_heading.h"

#include <cmath>

namespace pleinair::scene {

Mat3 MarkerFromWorld(const MarkerDescription& marker) {
  const double s = std::sin(marker.heading.value()), c = std::cos(marker.heading.value());
  if (marker.upright) return {{c, -s, 0, 0, 0, 1, -s, -c, 0}};
  return {{c, -s, 0, s, c, 0, 0, 0, 1}};
}

}  // namespace pleinair::scene
