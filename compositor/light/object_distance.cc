#include "compositor/light/object_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {

void ObjectDistance::Box::Add(const std::array<float, 3>& point) {
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], point[i]);
    high[i] = std::max(high[i], point[i]);
  }
}

ObjectDistance::ObjectDistance(const std::vector<SurfaceMesh>& surfaces) {
  constexpr std::size_t kMax = 32;
  for (const SurfaceMesh& surface : surfaces) {
    if (surface.is_phantom || surface.positions.empty()) continue;
    Box box{surface.positions[0], surface.positions[0]};
    for (const auto& point : surface.positions) box.Add(point);
    boxes_.push_back(box);
  }
  if (boxes_.empty()) boxes_.emplace_back();
  if (boxes_.size() <= kMax) return;
  Box all = boxes_[0];
  for (const Box& box : boxes_) {
    all.Add(box.low);
    all.Add(box.high);
  }
  boxes_ = {all};
}

double ObjectDistance::operator()(const std::array<float, 3>& point) const {
  double nearest = 1e300;
  for (const Box& box : boxes_) {
    double squared = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double outside = std::max({box.low[i] - point[i], point[i] - box.high[i], 0.0F});
      squared += outside * outside;
    }
    nearest = std::min(nearest, squared);
  }
  return std::sqrt(nearest);
}

}  // namespace pleinair::compositor
