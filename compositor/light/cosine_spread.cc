#include "compositor/light/cosine_spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "compositor/light/ray_scene.h"

namespace pleinair::compositor {

CosineSpread::CosineSpread(std::uint32_t count) {
  // Rings of as many packets as make a packet about as long as it is wide on the disc's rim.
  const double packets = static_cast<double>(count) / RayPacket::kSize;
  const double rings = std::max(1.0, std::round(std::sqrt(packets / 2.0)));
  struct Place {
    double ring;
    SamplePoint at;
    std::uint32_t ray;
  };
  std::vector<Place> places;
  places.reserve(count);
  for (std::uint32_t ray = 0; ray < count; ++ray) {
    const SamplePoint at = Hammersley(ray, count);
    places.push_back({std::floor(at.u * rings), at, ray});
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return std::tie(a.ring, a.at.v) < std::tie(b.ring, b.at.v);
  });
  points_.reserve(count);
  for (const Place& place : places) {
    const double angle = 2.0 * std::numbers::pi * place.at.v;
    points_.push_back({place.ray, place.at.u, std::cos(angle), std::sin(angle)});
  }
}

CosineSpread::Shift CosineSpread::ShiftOf(std::uint32_t seed) {
  const SamplePoint shift = HammersleyShift(seed);
  const double angle = 2.0 * std::numbers::pi * shift.v;
  return {shift.u, std::cos(angle), std::sin(angle)};
}

Vec3 CosineSpread::Direction(const TangentFrame& frame, std::uint32_t place,
                             const Shift& shift) const {
  const Point& point = points_[place];
  double u = point.u + shift.u;
  if (u >= 1.0) u -= 1.0;
  const double radius = std::sqrt(u);
  return frame.ToWorld(radius * (point.cosine * shift.cosine - point.sine * shift.sine),
                       radius * (point.sine * shift.cosine + point.cosine * shift.sine),
                       std::sqrt(1.0 - u));
}

}  // namespace pleinair::compositor
