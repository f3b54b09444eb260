#include "content/draping/surface_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pleinair::content {
namespace {

double Side(Vec2 a, Vec2 b, Vec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

}  // namespace

SurfaceView::SurfaceView(const SurfaceIndex& surface, const CameraModel& camera,
                         const Transform<World, Camera>& world_from_camera)
    : surface_(surface),
      camera_(camera),
      world_from_camera_(world_from_camera),
      camera_from_world_(world_from_camera.Inverse()),
      inverse_depth_(camera.width, camera.height, 1),
      triangles_(static_cast<std::size_t>(camera.width) * camera.height) {
  const auto count = static_cast<std::uint32_t>(surface.mesh().triangles.size());
  for (std::uint32_t triangle = 0; triangle < count; ++triangle) Draw(triangle);
}

std::optional<Vec2> SurfaceView::PixelOf(const Vec3& point) const {
  const Vec3 at = InCamera(point);
  if (at.z < kNear_m) return std::nullopt;
  return Vec2{camera_.cx + camera_.fx * at.x / at.z, camera_.cy + camera_.fy * at.y / at.z};
}

bool SurfaceView::InPicture(Vec2 pixel) const {
  return pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x <= camera_.width - 0.5 &&
         pixel.y <= camera_.height - 0.5;
}

Vec3 SurfaceView::AtDepth(Vec2 pixel, double depth_m) const {
  const Vec3 ray{(pixel.x - camera_.cx) / camera_.fx, (pixel.y - camera_.cy) / camera_.fy, 1.0};
  return (world_from_camera_ * Point<Camera>{ray * depth_m}).xyz;
}

void SurfaceView::Draw(std::uint32_t triangle) {
  std::array<Vec3, 3> corners = surface_.Corners(triangle);
  for (Vec3& corner : corners) corner = InCamera(corner);
  // What lies behind the near plane is cut off, which leaves up to four corners.
  std::array<Corner, 4> kept;
  std::size_t count = 0;
  const auto keep = [&](const Vec3& at) {
    kept[count++] = {{camera_.cx + camera_.fx * at.x / at.z, camera_.cy + camera_.fy * at.y / at.z},
                     1.0 / at.z};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = corners[i], &to = corners[(i + 1) % 3];
    if (from.z >= kNear_m) keep(from);
    if ((from.z >= kNear_m) == (to.z >= kNear_m)) continue;
    Vec3 cut = from + (to - from) * ((kNear_m - from.z) / (to.z - from.z));
    cut.z = kNear_m;
    keep(cut);
  }
  for (std::size_t i = 2; i < count; ++i) Fill(kept[0], kept[i - 1], kept[i], triangle);
}

void SurfaceView::Fill(const Corner& a, const Corner& b, const Corner& c, std::uint32_t triangle) {
  const double area = Side(a.pixel, b.pixel, c.pixel);
  if (area == 0.0) return;
  const auto first = [](double least, int size) {
    return static_cast<int>(std::clamp(std::ceil(least), 0.0, static_cast<double>(size)));
  };
  const auto last = [](double largest, int size) {
    return static_cast<int>(std::clamp(std::floor(largest), -1.0, size - 1.0));
  };
  const auto [left, right] = std::minmax({a.pixel.x, b.pixel.x, c.pixel.x});
  const auto [top, bottom] = std::minmax({a.pixel.y, b.pixel.y, c.pixel.y});
  const int last_x = last(right, camera_.width), last_y = last(bottom, camera_.height);
  for (int y = first(top, camera_.height); y <= last_y; ++y) {
    for (int x = first(left, camera_.width); x <= last_x; ++x) {
      const Vec2 pixel{static_cast<double>(x), static_cast<double>(y)};
      const double of_a = Side(b.pixel, c.pixel, pixel) / area;
      const double of_b = Side(c.pixel, a.pixel, pixel) / area;
      const double of_c = 1.0 - of_a - of_b;
      if (std::min({of_a, of_b, of_c}) < 0.0) continue;
      const auto inverse = static_cast<float>(of_a * a.inverse_depth + of_b * b.inverse_depth +
                                              of_c * c.inverse_depth);
      if (inverse <= inverse_depth_(x, y)) continue;
      inverse_depth_(x, y) = inverse;
      triangles_[static_cast<std::size_t>(y) * camera_.width + x] = triangle;
    }
  }
}

std::optional<SurfaceView::Sight> SurfaceView::At(Vec2 pixel) const {
  if (!InPicture(pixel)) return std::nullopt;
  const int x = std::clamp(static_cast<int>(std::lround(pixel.x)), 0, camera_.width - 1);
  const int y = std::clamp(static_cast<int>(std::lround(pixel.y)), 0, camera_.height - 1);
  const double inverse = inverse_depth_(x, y);
  if (inverse <= 0.0) return std::nullopt;
  const std::uint32_t triangle = triangles_[static_cast<std::size_t>(y) * camera_.width + x];
  std::array<Vec3, 3> corners = surface_.Corners(triangle);
  double nearest_m = 1.0 / inverse, farthest_m = nearest_m;
  for (Vec3& corner : corners) {
    corner = InCamera(corner);
    nearest_m = std::min(nearest_m, std::max(corner.z, kNear_m));
    farthest_m = std::max(farthest_m, corner.z);
  }
  // The plane n · p = d at the ray p = depth (u, v, 1).
  const Vec3 normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double along = normal.x * (pixel.x - camera_.cx) / camera_.fx +
                       normal.y * (pixel.y - camera_.cy) / camera_.fy + normal.z;
  const double depth_m = along != 0.0 ? Dot(normal, corners[0]) / along : 1.0 / inverse;
  // Beside a silhouette, the plane would leave the triangle.
  const bool is_ahead = depth_m > 0.0;
  return Sight{AtDepth(pixel, is_ahead ? std::clamp(depth_m, nearest_m, farthest_m) : farthest_m),
               triangle};
}

bool IsHiddenFrom(const SurfaceIndex& surface, const Vec3& camera, const Vec3& point) {
  constexpr double kBefore_m = 0.01;
  const Vec3 way = point - camera;
  const double last = 1.0 - kBefore_m / std::max(Norm(way), kBefore_m);
  bool hidden = false;
  surface.VisitAlong({camera.x, camera.y}, {point.x, point.y}, [&](std::uint32_t triangle) {
    if (hidden) return;
    // Möller and Trumbore 1997.
    const std::array<Vec3, 3> corners = surface.Corners(triangle);
    const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const Vec3 p = Cross(way, v);
    const double determinant = Dot(u, p);
    if (determinant == 0.0) return;
    const Vec3 from = camera - corners[0];
    const double s = Dot(from, p) / determinant;
    const Vec3 q = Cross(from, u);
    const double t = Dot(way, q) / determinant;
    const double at = Dot(v, q) / determinant;
    hidden = s >= 0.0 && t >= 0.0 && s + t <= 1.0 && at > 0.0 && at < last;
  });
  return hidden;
}

}  // namespace pleinair::content
