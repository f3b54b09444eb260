#include "app/window/object_moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/units.h"

namespace pleinair::app {
namespace {

constexpr double kMinObjectScale = 1e-6, kMaxObjectScale = 1e6;
// Min. slope of the view: below it, rays meet level ground near the horizon.
constexpr double kMinSlope = 0.02;

/// Inverse of a rotation times a scale.
Mat3 Inverse(const Mat3& linear, double scale) {
  Mat3 inverse = linear.Transposed();
  for (double& element : inverse.m) element /= scale * scale;
  return inverse;
}

Mat3 RotationAbout(Vec3 axis, double angle) {
  // Rodrigues' formula.
  const double c = std::cos(angle), s = std::sin(angle), k = 1.0 - c;
  const auto [x, y, z] = std::array{axis.x, axis.y, axis.z};
  return {{c + k * x * x, k * x * y - s * z, k * x * z + s * y, k * x * y + s * z, c + k * y * y,
           k * y * z - s * x, k * x * z - s * y, k * y * z + s * x, c + k * z * z}};
}

/// Rotation angles about x, then y, then z, degrees.
Vec3 AnglesOf(const Mat3& r) {
  const double y = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  const bool straight_up = std::abs(r(2, 0)) > 1.0 - 1e-12;
  const double x = straight_up ? std::atan2(-r(1, 2), r(1, 1)) : std::atan2(r(2, 1), r(2, 2));
  const double z = straight_up ? 0.0 : std::atan2(r(1, 0), r(0, 0));
  return Vec3{x, y, z} * (1.0 / kRadiansPerDegree);
}

/// Adjusts the translation after a change of rotation or scale, so that a model point stays fixed.
session::ObjectPlace Keeping(Vec3 point, const session::ObjectPlace& before,
                             session::ObjectPlace after) {
  const Vec3 in_model =
      Inverse(session::LinearOf(before), before.scale) * (point - before.translation_m);
  after.translation_m = point - session::LinearOf(after) * in_model;
  return after;
}

}  // namespace

Vec3 BoxCorner(const ObjectBox& box, const session::ObjectPlace& place, int corner) {
  const Vec3 in_model{(corner & 1) != 0 ? box.max.x : box.min.x,
                      (corner & 2) != 0 ? box.max.y : box.min.y,
                      (corner & 4) != 0 ? box.max.z : box.min.z};
  return session::LinearOf(place) * in_model + place.translation_m;
}

Vec3 BoxFoot(const ObjectBox& box, const session::ObjectPlace& place, Vec3 up) {
  Vec3 middle;
  double lowest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at = BoxCorner(box, place, corner);
    middle = middle + at * 0.125;
    lowest = std::min(lowest, Dot(at, up));
  }
  return middle + up * (lowest - Dot(middle, up));
}

std::optional<int> PickObject(std::span<const ObjectBox> boxes,
                              std::span<const session::ObjectPlace> places, const Sight& sight) {
  std::optional<int> picked;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(boxes.size(), places.size()); ++i) {
    const Mat3 model_from_marker = Inverse(session::LinearOf(places[i]), places[i].scale);
    const Vec3 eye = model_from_marker * (sight.eye - places[i].translation_m);
    const Vec3 direction = model_from_marker * sight.direction;
    double enter = 0.0, leave = std::numeric_limits<double>::infinity();
    const auto slab = [&](double from, double step, double low, double high) {
      double a = (low - from) / step, b = (high - from) / step;
      if (a > b) std::swap(a, b);
      // A ray parallel to the slab is inside it always or never.
      if (step == 0.0) a = from < low || from > high ? leave + 1.0 : enter;
      if (step == 0.0) b = leave;
      enter = std::max(enter, a);
      leave = std::min(leave, b);
    };
    slab(eye.x, direction.x, boxes[i].min.x, boxes[i].max.x);
    slab(eye.y, direction.y, boxes[i].min.y, boxes[i].max.y);
    slab(eye.z, direction.z, boxes[i].min.z, boxes[i].max.z);
    if (enter > leave || enter >= nearest) continue;
    nearest = enter;
    picked = static_cast<int>(i);
  }
  return picked;
}

ViewerAxes AxesOf(const Transform<Camera, Marker>& camera_from_marker, Vec3 up) {
  const Vec3 right = camera_from_marker.rotation.Transposed() * Vec3{1.0, 0.0, 0.0};
  const Vec3 level = right - up * Dot(right, up);
  const Vec3 unit = Norm(level) > 1e-6 ? Normalized(level) : Vec3{1.0, 0.0, 0.0};
  return {unit, Cross(up, unit)};
}

session::ObjectPlace DraggedLevel(const session::ObjectPlace& place, const Sight& from,
                                  const Sight& to, Vec3 hold, Vec3 up) {
  if (std::abs(Dot(to.direction, up)) < kMinSlope) return place;
  const auto start = MeetPlane(from, hold, up), end = MeetPlane(to, hold, up);
  if (!start || !end) return place;
  session::ObjectPlace moved = place;
  moved.translation_m = moved.translation_m + (*end - *start);
  return moved;
}

session::ObjectPlace DraggedUpright(const session::ObjectPlace& place, const Sight& from,
                                    const Sight& to, Vec3 hold, Vec3 up) {
  const Vec3 facing = from.direction - up * Dot(from.direction, up);
  if (Norm(facing) < kMinSlope) return place;
  const auto start = MeetPlane(from, hold, Normalized(facing));
  const auto end = MeetPlane(to, hold, Normalized(facing));
  if (!start || !end) return place;
  session::ObjectPlace moved = place;
  moved.translation_m = moved.translation_m + up * Dot(*end - *start, up);
  return moved;
}

session::ObjectPlace Turned(const ObjectBox& box, const session::ObjectPlace& place, double degrees,
                            Vec3 up) {
  Mat3 rotation = RotationAbout(up, degrees * kRadiansPerDegree) * session::LinearOf(place);
  for (double& element : rotation.m) element /= place.scale;
  session::ObjectPlace turned = place;
  turned.rotation_deg = AnglesOf(rotation);
  return Keeping(BoxFoot(box, place, up), place, turned);
}

session::ObjectPlace Scaled(const ObjectBox& box, const session::ObjectPlace& place, double factor,
                            Vec3 up) {
  session::ObjectPlace scaled = place;
  scaled.scale = std::clamp(place.scale * factor, kMinObjectScale, kMaxObjectScale);
  return Keeping(BoxFoot(box, place, up), place, scaled);
}

}  // namespace pleinair::app
