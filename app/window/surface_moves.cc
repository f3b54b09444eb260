#include "app/window/surface_moves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "app/window/north_pole.h"
#include "app/window/object_moves.h"
#include "scene/described_surface.h"

namespace pleinair::app {
namespace {

using scene::SurfaceKind;
using session::SurfacePlace;

// Max. height of the marker above the ground, as in scenes.
constexpr double kMaxGroundHeight_m = 1e3;
// Min. sine between a viewing ray and a wall's normal: along the normal, nothing shows how far.
constexpr double kMinAcross = 0.05;

Vec3 NormalOf(const std::vector<Vec3>& polygon) {
  Vec3 normal;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    normal = normal + Cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return Normalized(normal);
}

/// Where a ray meets a convex polygon.
std::optional<Vec3> MeetPolygon(const Sight& sight, const std::vector<Vec3>& polygon) {
  const Vec3 normal = NormalOf(polygon);
  const auto at = MeetPlane(sight, polygon[0], normal);
  if (!at) return std::nullopt;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (Dot(Cross(edge, *at - polygon[i]), normal) < 0.0) return std::nullopt;
  }
  return at;
}

std::optional<SurfaceGrip> PickCorner(const scene::SceneDescription& scene, const Sight& sight,
                                      double radius) {
  std::optional<SurfaceGrip> picked;
  double smallest = radius;
  for (std::size_t i = 0; i < scene.phantoms.size(); ++i) {
    const scene::ModelReference& phantom = scene.phantoms[i];
    if (!phantom.surface || phantom.surface->kind != SurfaceKind::kWall) continue;
    const std::vector<Vec3> corners = PlacedPolygons(phantom).at(0);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Vec3 towards = corners[c] - sight.eye;
      const double angle =
          std::atan2(Norm(Cross(sight.direction, towards)), Dot(sight.direction, towards));
      if (angle >= smallest) continue;
      smallest = angle;
      picked = SurfaceGrip{static_cast<int>(i), static_cast<int>(c), corners[c]};
    }
  }
  return picked;
}

/// Distance from `hold` along `normal` to the point next to a ray.
std::optional<double> AlongNormal(const Sight& sight, Vec3 hold, Vec3 normal) {
  const double cosine = Dot(sight.direction, normal);
  const double sine_squared = 1.0 - cosine * cosine;
  if (sine_squared < kMinAcross * kMinAcross) return std::nullopt;
  const Vec3 between = hold - sight.eye;
  const double along = Dot(between, sight.direction);
  const double distance_m = (cosine * along - Dot(between, normal)) / sine_squared;
  if (along + distance_m * cosine <= 0.0) return std::nullopt;  // Behind the viewer.
  return distance_m;
}

/// Coordinates of a surface's file from a direction in marker coordinates.
Vec3 OfSurface(const scene::ModelReference& phantom, Vec3 in_marker) {
  return session::RotationXyz(phantom.rotation_deg).Transposed() * in_marker;
}

std::optional<SurfacePlace> DraggedWall(const scene::ModelReference& phantom,
                                        const SurfacePlace& start, const SurfaceGrip& grip,
                                        const Sight& from, const Sight& to) {
  const Vec3 normal = NormalOf(PlacedPolygons(phantom).at(0));
  SurfacePlace moved = start;
  if (grip.corner) {
    const auto begin = MeetPlane(from, grip.hold, normal), end = MeetPlane(to, grip.hold, normal);
    if (!begin || !end) return std::nullopt;
    Vec3& corner = moved.corners_m[static_cast<std::size_t>(*grip.corner)];
    corner = corner + OfSurface(phantom, *end - *begin);
  } else {
    const auto begin = AlongNormal(from, grip.hold, normal);
    const auto end = AlongNormal(to, grip.hold, normal);
    if (!begin || !end) return std::nullopt;
    const Vec3 step = OfSurface(phantom, normal * (*end - *begin));
    for (Vec3& corner : moved.corners_m) corner = corner + step;
  }
  if (!scene::WallSurface(moved.corners_m)) return std::nullopt;
  return moved;
}

}  // namespace

std::vector<std::vector<Vec3>> PlacedPolygons(const scene::ModelReference& phantom) {
  if (!phantom.surface) return {};
  const Mat3 rotation = session::RotationXyz(phantom.rotation_deg);
  std::vector<std::vector<Vec3>> polygons = phantom.surface->polygons;
  for (std::vector<Vec3>& polygon : polygons) {
    for (Vec3& corner : polygon) corner = rotation * corner + phantom.translation_m;
  }
  return polygons;
}

std::optional<SurfaceGrip> PickSurface(const scene::SceneDescription& scene, const Sight& sight,
                                       double corner_radius) {
  if (auto corner = PickCorner(scene, sight, corner_radius)) return corner;
  std::optional<SurfaceGrip> picked;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.phantoms.size(); ++i) {
    for (const std::vector<Vec3>& polygon : PlacedPolygons(scene.phantoms[i])) {
      const auto at = MeetPolygon(sight, polygon);
      if (!at || Norm(*at - sight.eye) >= nearest) continue;
      nearest = Norm(*at - sight.eye);
      picked = SurfaceGrip{static_cast<int>(i), std::nullopt, *at};
    }
  }
  return picked;
}

std::optional<SurfacePlace> DraggedSurface(const scene::SceneDescription& scene,
                                           const SurfacePlace& start, const SurfaceGrip& grip,
                                           const Sight& from, const Sight& to, bool upright) {
  scene::ModelReference phantom = scene.phantoms[static_cast<std::size_t>(grip.phantom)];
  if (!phantom.surface) return std::nullopt;
  const SurfaceKind kind = phantom.surface->kind;
  if (kind == SurfaceKind::kWall) {
    phantom.surface->polygons = {start.corners_m};
    return DraggedWall(phantom, start, grip, from, to);
  }
  const Vec3 up = UpOf(scene.marker);
  const session::ObjectPlace place{start.translation_m, phantom.rotation_deg, 1.0};
  const bool vertically = upright || kind == SurfaceKind::kGround;
  SurfacePlace moved = start;
  moved.translation_m = vertically ? DraggedUpright(place, from, to, grip.hold, up).translation_m
                                   : DraggedLevel(place, from, to, grip.hold, up).translation_m;
  if (kind == SurfaceKind::kGround) {
    phantom.translation_m = moved.translation_m;
    const double height_m = GroundHeight(scene, phantom);
    if (height_m < 0.0 || height_m > kMaxGroundHeight_m) return std::nullopt;
  }
  return moved;
}

double GroundHeight(const scene::SceneDescription& scene, const scene::ModelReference& ground) {
  return -Dot(PlacedPolygons(ground).at(0).at(0), UpOf(scene.marker));
}

}  // namespace pleinair::app
