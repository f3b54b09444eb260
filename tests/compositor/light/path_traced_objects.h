#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "compositor/light/ray_scene.h"
#include "compositor/light/sampling.h"
#include "compositor/models/model.h"
#include "tests/compositor/light/path_tracer.h"

namespace pleinair::compositor::testing {

/// Virtual objects in an image as the path tracer lights them: a reference for composed images.
/// Models are placed without a transform. Objects have one color each.
///
/// A coarse mesh with smooth normals represents a curved surface. Rays therefore start at the
/// curved surface through the vertices (Hanika 2021, "Hacking the shadow terminator", Ray Tracing
/// Gems II), and light arrives around the interpolated normal.
class PathTracedObjects {
 public:
  PathTracedObjects(const std::vector<const Model*>& phantoms,
                    const std::vector<const Model*>& objects, const sky::SkyModel& day)
      : day_(day), tracer_(Joined(phantoms, objects), day) {
    std::vector<RayMesh> meshes;
    const auto add = [&](const Model& model, int object) {
      for (const Mesh& mesh : model.meshes) {
        meshes.push_back({mesh.positions, mesh.indices, false});
        const Material& material = model.materials[mesh.material];
        const auto& [r, g, b] = material.base_color;
        const auto& [u, v, w] = material.detail.transmission.color;
        sources_.push_back({&mesh, {r, g, b}, {u, v, w}, object});
      }
    };
    for (const Model* model : phantoms) add(*model, -1);
    for (std::size_t i = 0; i < objects.size(); ++i) add(*objects[i], static_cast<int>(i));
    rays_ = *RayScene::Create(meshes, "reference");
  }

  struct Seen {
    int object = 0;  ///< Index into the objects.
    LinearRgb radiance;
  };

  /// What an object reflects along a ray, from `strata`² paths; empty if the ray hits no object.
  std::optional<Seen> Along(Vec3 eye, Vec3 direction, int strata, std::uint32_t seed) const {
    RayHit hit;
    if (!rays_->Intersect(RayTargets::kEverything, eye, direction, &hit)) return {};
    const Source& source = sources_[hit.mesh];
    if (source.object < 0) return {};
    const Vec3 at = eye + direction * hit.distance_m;
    const auto light = [&](Vec3 towards) { return LightOn(hit, at, towards, strata, seed); };
    LinearRgb leaving = light(-direction) * source.albedo;
    if (Luminance(source.transmittance) > 0.0) {
      leaving = leaving + light(direction) * source.transmittance;
    }
    return Seen{source.object, leaving * std::numbers::inv_pi};
  }

 private:
  struct Source {
    const Mesh* mesh = nullptr;
    LinearRgb albedo, transmittance;
    int object = -1;  ///< −1: a phantom.
  };

  static constexpr double kOffset_m = 1e-5;

  /// Irradiance of the side of a triangle that faces `towards`.
  LinearRgb LightOn(const RayHit& hit, Vec3 flat, Vec3 towards, int strata,
                    std::uint32_t seed) const {
    const Mesh* mesh = sources_[hit.mesh].mesh;
    const std::array<double, 3> weights{1.0 - hit.u - hit.v, hit.u, hit.v};
    std::array<Vec3, 3> corners, normals;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh->indices[3 * hit.triangle + k];
      corners[k] = ToVec3(mesh->positions[v]);
      normals[k] = ToVec3(mesh->normals[v]);
    }
    Vec3 face = Normalized(Cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (Dot(face, towards) < 0.0) face = -face;
    Vec3 normal, point;
    for (int k = 0; k < 3; ++k) {
      if (Dot(normals[k], face) < 0.0) normals[k] = -normals[k];
      normal = normal + normals[k] * weights[k];
      const double below = std::min(0.0, Dot(flat - corners[k], normals[k]));
      point = point + (flat - normals[k] * below) * weights[k];
    }
    normal = Normalized(normal);
    point = point + face * kOffset_m;
    return tracer_.Irradiance({point}, normal, strata, seed) +
           Sunlight(point, normal, strata, seed);
  }

  static std::vector<const Model*> Joined(std::vector<const Model*> first,
                                          const std::vector<const Model*>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }

  static Vec3 ToVec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

  LinearRgb Sunlight(Vec3 point, Vec3 normal, int strata, std::uint32_t seed) const {
    const Vec3 to_sun = day_.ToSun().xyz;
    const double cosine = Dot(normal, to_sun);
    if (cosine <= 0.0) return {};
    const TangentFrame frame(to_sun);
    const auto rays = static_cast<std::uint32_t>(strata);
    int lit = 0;
    for (std::uint32_t i = 0; i < rays; ++i) {
      const Vec3 way = SunDiscDirection(frame, ShiftedHammersley(i, rays, seed));
      lit += tracer_.IsLitFrom(way, point) ? 1 : 0;
    }
    return day_.SunNormalIrradiance() * (cosine * lit / strata);
  }

  const sky::SkyModel& day_;
  PathTracer tracer_;
  std::vector<Source> sources_;  ///< By mesh of `rays_`.
  std::unique_ptr<RayScene> rays_;
};

}  // namespace pleinair::compositor::testing
