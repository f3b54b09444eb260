#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// Triangles for ray queries; marker coordinates, metres.
struct RayMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> indices;  ///< Three per triangle.
  bool is_phantom = false;
};

/// The nearest surface along a ray.
struct RayHit {
  std::uint32_t mesh = 0;      ///< Index into the list passed to RayScene::Create().
  std::uint32_t triangle = 0;  ///< Index within the mesh.
  float u = 0.0F, v = 0.0F;    ///< Barycentric weights of the second and third corner.
  double distance_m = 0.0;
  bool back = false;  ///< Hit on the side from which the corners run clockwise.
};

/// Which surfaces a ray may hit.
enum class RayTargets { kEverything, kPhantoms };

/// Up to eight rays that are followed at once. This is fastest where they are close to each other.
/// One bit per ray states which of them are traced.
struct RayPacket {
  static constexpr std::size_t kSize = 8;
  static constexpr unsigned kAll = (1U << kSize) - 1U;
  std::array<Vec3, kSize> origins, directions;  ///< Directions are unit vectors.
};

/// Ray queries against the scene's triangles (Embree 3.13), thread-safe after creation. A ray finds
/// the same hit for any number of threads.
class RayScene {
 public:
  /// `where` is the file that errors name. Errors: Embree cannot start or is out of memory.
  static Result<std::unique_ptr<RayScene>> Create(const std::vector<RayMesh>& meshes,
                                                  const std::string& where);
  virtual ~RayScene() = default;

  /// Moves the vertices of all meshes: one list per mesh of Create(), as long as before. The order
  /// of the search stays, so that this is cheap, but queries are slower after large changes. Not
  /// while others query.
  virtual void SetPositions(std::span<const std::vector<std::array<float, 3>>> positions) = 0;

  /// Finds the nearest hit from `origin` along the unit vector `direction`. Returns false if there
  /// is none.
  virtual bool Intersect(RayTargets targets, Vec3 origin, Vec3 direction, RayHit* hit) const = 0;

  /// Finds the nearest hits of the rays in `followed`. Returns the rays that have one; the others'
  /// entries of `hits` stay.
  virtual unsigned Intersect(RayTargets targets, const RayPacket& rays, unsigned followed,
                             std::array<RayHit, RayPacket::kSize>* hits) const = 0;

  /// Returns those rays of `followed` along which any surface lies.
  virtual unsigned Occluded(RayTargets targets, const RayPacket& rays, unsigned followed) const = 0;

  /// Returns whether any surface lies along the ray.
  virtual bool Occluded(RayTargets targets, Vec3 origin, Vec3 direction) const = 0;
};

}  // namespace pleinair::compositor
