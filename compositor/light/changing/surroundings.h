#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/ray_scene.h"
#include "compositor/light/sky_table.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Where a ray ends, and the light that comes along it: cd/m², linear Rec.709.
struct SeenAlongRay {
  enum class What { kSky, kLand, kStill, kBody, kInside } what = What::kSky;
  std::array<float, 3> radiance{};  ///< Zero inside of a closed body.
  std::array<float, 3> sunlight{};  ///< The part of it that is reflected sunlight.
};

/// What rays see around bodies that change: the sky, still surfaces, and the bodies. Surfaces
/// reflect the light at their vertices and, where no surface occludes it, the sun. Thread-safe
/// between changes.
class Surroundings {
 public:
  /// Coarser triangles in place of those of a fine mesh. They are nearly the mesh, so that rays
  /// from the mesh must not see them before `gap_m`.
  struct Coarse {
    std::vector<std::uint32_t> vertices;  ///< Indices in the mesh. Empty: its own triangles.
    std::vector<std::uint32_t> indices;   ///< Three per triangle, of `vertices`.
    double gap_m = 0.0;
  };

  /// One side of a surface, or both.
  struct Surface {
    const LitMesh* front = nullptr;
    const LitMesh* back = nullptr;  ///< Null for a closed body.
    std::array<float, 3> albedo{}, transmittance{};
    Coarse coarse;

    /// A corner of a triangle, as a vertex of the mesh.
    std::uint32_t Corner(std::size_t index) const {
      return coarse.vertices.empty() ? front->indices[index]
                                     : coarse.vertices[coarse.indices[index]];
    }
    /// The vertices that rays see.
    std::vector<std::array<float, 3>> Positions() const;
  };

  void SetDaylight(const sky::SkyModel& day, const Mat3& marker_from_world);
  /// The surfaces' meshes must outlive their use; their light may change between queries. Errors as
  /// RayScene::Create().
  Result<void> SetStill(std::vector<Surface> surfaces);
  Result<void> SetBodies(std::vector<Surface> surfaces);
  /// Follows the current positions of the bodies' meshes.
  void MoveBodies();

  const SkyTable& sky() const { return *sky_; }
  /// `direction`: unit.
  SeenAlongRay Look(Vec3 origin, Vec3 direction) const;
  /// As Look(), but sees bodies alone, if no still surface is before them.
  std::optional<SeenAlongRay> LookAtBodies(Vec3 origin, Vec3 direction) const;
  /// The radiance, cd/m², that a still surface along the ray would reflect of the sun if no body
  /// shaded it. Zero where none does, or where a body is before the surface.
  std::array<float, 3> ShadedSunlight(Vec3 origin, Vec3 direction) const;
  /// Returns whether a still surface lies along the ray.
  bool IsBehindStill(Vec3 origin, Vec3 direction) const {
    return still_rays_->Occluded(RayTargets::kEverything, origin, direction);
  }

 private:
  static Result<std::unique_ptr<RayScene>> RaysOf(std::span<const Surface> surfaces);
  SeenAlongRay LightFrom(const Surface& surface, const RayHit& hit, Vec3 origin, Vec3 direction,
                         SeenAlongRay::What what) const;
  /// Adds the light of the side of a surface that `hit` names, times its albedo or transmittance.
  void AddLightOf(const Surface& surface, const RayHit& hit, Vec3 origin, Vec3 direction,
                  const std::array<float, 3>& albedo, SeenAlongRay* seen) const;
  /// The sun on a surface that a ray hit, if nothing shades it. `point`: from which rays to the sun
  /// start.
  LinearRgb UnshadedSun(const Surface& surface, const RayHit& hit, Vec3 origin, Vec3 direction,
                        Vec3* point) const;

  bool IsShadedByBodies(Vec3 point) const {
    return body_rays_->Occluded(RayTargets::kEverything, point + to_sun_ * gap_m_, to_sun_);
  }
  /// The nearest body along a ray.
  bool SeesBody(Vec3 origin, Vec3 direction, RayHit* hit) const;

  std::vector<Surface> still_, bodies_;
  double gap_m_ = 0.0;  // Maximum of the bodies' Coarse::gap_m.
  std::unique_ptr<RayScene> still_rays_, body_rays_;
  std::optional<SkyTable> sky_;
  Vec3 to_sun_;
  LinearRgb sun_lux_;
};

/// Pairs the two sides of each open surface among `meshes` and leaves out what occludes no light.
inline std::vector<Surroundings::Surface> PairedSides(std::span<const LitMesh> meshes) {
  std::vector<Surroundings::Surface> surfaces;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const LitMesh* front = &meshes[i];
    const LitMesh* back = nullptr;
    if (i + 1 < meshes.size()) {
      const LitMesh& next = meshes[i + 1];
      if (front->texturing.is_back != next.texturing.is_back &&
          front->positions.size() == next.positions.size() && front->positions == next.positions) {
        back = &next;
        if (front->texturing.is_back) std::swap(front, back);
        ++i;
      }
    }
    if (front->role == MeshRole::kRenderOnly) continue;
    surfaces.push_back(
        {front, back, front->texturing.reflectance, front->texturing.transmittance, {}});
  }
  return surfaces;
}

}  // namespace pleinair::compositor
