#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/mesh_orientation.h"
#include "compositor/ray_scene.h"

namespace pleinair::compositor {

struct PlacedModel;
struct LightSolverOptions;

/// The scene as the light solver sees it: tessellated sheets of vertices that store light, and
/// the faces that rays hit. An open surface is two sheets, one for each side; a closed body one.
struct LightScene {
  struct Sheet {
    SurfaceMesh mesh;
    std::array<float, 3> albedo{};  ///< Diffuse, linear; texture averaged; metals have none.
    std::uint32_t first_vertex = 0;
    int twin = -1;  ///< The other side's sheet.
  };

  struct Face {
    std::array<std::uint32_t, 3> vertices{};  ///< Scene-wide, of the front's sheet.
    std::uint32_t back_offset = 0;  ///< To add for the back's vertices; 0: the back is inside.
    std::uint32_t sheet = 0;        ///< Of the front.
    Vec3 normal;                    ///< Of the front, unit.
  };

  std::vector<Sheet> sheets;
  std::vector<Face> faces;
  std::vector<std::uint32_t> first_face;  ///< By mesh of the ray scene.
  std::uint32_t vertex_count = 0;
  /// Where each vertex gathers light: a little above its surface and away from its edges.
  std::vector<Vec3> gather_origins;
  std::unique_ptr<RayScene> rays;

  const Face& FaceOf(const RayHit& hit) const { return faces[first_face[hit.mesh] + hit.triangle]; }

  static Result<LightScene> Create(const std::vector<PlacedModel>& models,
                                   const LightSolverOptions& options);
};

/// How far rays start above a surface, metres.
inline constexpr double kRayOffsetM = 3e-4;

}  // namespace pleinair::compositor
