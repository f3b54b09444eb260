#include "app/bench/shadow_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel_for.h"

namespace pleinair::app {
namespace {

Vec3 ToVec3(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Ray offset above its surface, because positions are floats.
double Lift(const glm::dvec3& point) { return 2e-6 * (1.0 + glm::length(point)) + 2e-5; }

}  // namespace

Result<ShadowTruth> ShadowTruth::Create(const shadows::BenchScene& scene, int rays) {
  ShadowTruth truth;
  std::vector<compositor::RayMesh> meshes;
  for (const shadows::BenchMesh& mesh : scene.meshes) {
    compositor::RayMesh& ray_mesh = meshes.emplace_back();
    for (const glm::vec3& p : mesh.positions) ray_mesh.positions.push_back({p.x, p.y, p.z});
    ray_mesh.indices = mesh.indices;
    truth.albedos_.push_back(mesh.albedo);
    truth.leaves_.push_back(mesh.leaves);
    std::vector<glm::dvec3>& normals = truth.triangle_normals_.emplace_back();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
      const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
      const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      const double size = glm::length(normal);
      normals.push_back(size > 0.0 ? normal / size : glm::dvec3(0.0, 0.0, 1.0));
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(auto rays_scene, compositor::RayScene::Create(meshes, scene.name));
  truth.rays_scene_ = std::move(rays_scene);
  truth.to_sun_ = glm::normalize(scene.to_sun);
  const shadows::LightAxes axes = shadows::LightAxes::FromSun(scene.to_sun);
  const double tangent = std::tan(shadows::kSunAngularRadius.value());
  for (int i = 0; i < rays; ++i) {
    // Vogel's spiral: uniform over the disc.
    const double radius = tangent * std::sqrt((i + 0.5) / rays);
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    truth.directions_.push_back(ToVec3(glm::normalize(
        axes.to_sun + radius * (std::cos(angle) * axes.u + std::sin(angle) * axes.v))));
  }
  return truth;
}

ShadowTruth::Hit ShadowTruth::Trace(const shadows::View& view, const glm::dvec3& eye, double x,
                                    double y, int width, int height) const {
  const glm::dvec3 in_camera(-view.tan_left + (view.tan_left + view.tan_right) * x / width,
                             -view.tan_up + (view.tan_up + view.tan_down) * y / height, 1.0);
  const glm::dvec3 direction =
      glm::normalize(glm::transpose(glm::dmat3(view.camera_from_marker)) * in_camera);
  compositor::RayHit ray_hit;
  Hit hit;
  if (!rays_scene_->Intersect(compositor::RayTargets::kEverything, ToVec3(eye), ToVec3(direction),
                              &ray_hit)) {
    return hit;
  }
  hit.mesh = ray_hit.mesh;
  hit.point = eye + ray_hit.distance_m * direction;
  hit.depth_m = ray_hit.distance_m / glm::length(in_camera);
  hit.normal = triangle_normals_[ray_hit.mesh][ray_hit.triangle];
  if (glm::dot(hit.normal, direction) > 0.0) hit.normal = -hit.normal;
  return hit;
}

double ShadowTruth::FreeShare(const glm::dvec3& point, const glm::dvec3& normal, int first,
                              int step) const {
  if (glm::dot(normal, to_sun_) <= 0.0) return 0.0;
  const Vec3 origin = ToVec3(point + Lift(point) * normal);
  int free = 0, count = 0;
  for (int i = first; i < static_cast<int>(directions_.size()); i += step) {
    ++count;
    if (!rays_scene_->Occluded(compositor::RayTargets::kEverything, origin, directions_[i])) ++free;
  }
  return static_cast<double>(free) / count;
}

SurfacePicture ShadowTruth::Surfaces(const shadows::View& view, int width, int height) const {
  SurfacePicture picture{Image<float>(width, height, 3), Image<float>(width, height),
                         Image<float>(width, height)};
  const glm::dvec3 eye(glm::inverse(view.camera_from_marker)[3]);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Hit hit = Trace(view, eye, x + 0.5, y + 0.5, width, height);
      if (hit.depth_m <= 0.0) continue;
      for (int c = 0; c < 3; ++c) picture.albedo(x, y, c) = albedos_[hit.mesh][c];
      picture.leaves(x, y) = leaves_[hit.mesh] ? 1.0F : 0.0F;
      picture.cosine(x, y) = static_cast<float>(std::max(glm::dot(hit.normal, to_sun_), 0.0));
    }
  }
  return picture;
}

double ShadowTruth::At(const glm::dvec3& point, const glm::dvec3& normal) const {
  return FreeShare(point, normal, 0, 1);
}

shadows::VisibilityPicture ShadowTruth::Render(const shadows::View& view, int width, int height,
                                               PixelWindow window) const {
  shadows::VisibilityPicture picture{Image<float>(width, height), Image<float>(width, height)};
  const glm::dvec3 eye(glm::inverse(view.camera_from_marker)[3]);
  const int places = std::max(
      1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(directions_.size())))));
  ParallelFor(static_cast<std::size_t>(window.height), 0, [&](std::size_t row) {
    const int y = window.y + static_cast<int>(row);
    for (int x = window.x; x < window.x + window.width; ++x) {
      const Hit centre = Trace(view, eye, x + 0.5, y + 0.5, width, height);
      if (centre.depth_m <= 0.0) continue;
      picture.depth_m(x, y) = static_cast<float>(centre.depth_m);
      double sum = 0.0;
      int count = 0;
      for (int place = 0; place < places; ++place) {
        // R2 sequence (Roberts 2018): uniform over the pixel.
        const double dx = std::fmod(0.5 + (place + 1) * 0.7548776662466927, 1.0) - 0.5;
        const double dy = std::fmod(0.5 + (place + 1) * 0.5698402909980532, 1.0) - 0.5;
        const Hit hit = Trace(view, eye, x + 0.5 + dx, y + 0.5 + dy, width, height);
        const double off_plane = std::abs(glm::dot(hit.point - centre.point, centre.normal));
        if (hit.depth_m <= 0.0 || glm::dot(hit.normal, centre.normal) < 0.9 ||
            off_plane > 0.002 * centre.depth_m) {
          continue;
        }
        sum += FreeShare(hit.point, hit.normal, place, places);
        ++count;
      }
      picture.visibility(x, y) = static_cast<float>(
          count > 0 ? sum / count : FreeShare(centre.point, centre.normal, 0, 1));
    }
  });
  return picture;
}

}  // namespace pleinair::app
