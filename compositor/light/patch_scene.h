#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/gather_origin.h"
#include "compositor/light/ray_scene.h"
#include "compositor/light/surface_patches.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

struct PlacedModel;
struct LightSolverOptions;

/// The light solver's scene: mesh sides with patches that gather and store light, and the faces
/// that rays hit. An open surface has two mesh sides, one per side; a closed body has one. Each
/// vertex of a tessellated surface is a patch. If there are too many vertices, a patch is a group
/// of them (surface_patches.h).
///
/// Objects that change their shape (PlacedModel::playback) neither gather nor occlude light here.
/// Surfaces near them are as finely divided as near still ones.
struct PatchScene {
  struct MeshSide {
    SurfaceMesh mesh;
    std::array<float, 3> albedo{};  ///< Linear; mean of the texture; a metal's color.
    /// From one side of an open virtual surface to the other; linear, mean of the texture.
    std::array<float, 3> transmittance{};
    std::uint32_t first_patch = 0, patch_count = 0;
    int twin = -1;                                 ///< Index of the other side's mesh side.
    std::shared_ptr<const SurfacePatches> groups;  ///< Null: each vertex is a patch.
  };

  /// Where a patch gathers light: slightly above its surface and away from its edges.
  struct PatchSample {
    Vec3 origin;
    std::array<float, 3> normal{};
  };

  struct Face {
    std::array<std::uint32_t, 3>
        patches{};  ///< At the corners; scene-wide indices of the front's mesh side.
    std::uint32_t back_offset = 0;  ///< Offset to the back's patches; 0: the back is inside a body.
    std::uint32_t mesh_side = 0;    ///< Mesh side of the front.
    Vec3 normal;                    ///< Front normal, unit.
  };

  std::vector<MeshSide> mesh_sides;
  std::vector<Face> faces;                ///< That rays hit; without render-only geometry.
  std::vector<std::uint32_t> first_face;  ///< One entry per mesh of the ray scene.
  std::uint32_t patch_count = 0;
  std::vector<PatchSample> surface_samples;        ///< Grouped by patch.
  std::vector<std::uint32_t> surface_sample_ends;  ///< One past each patch's last surface sample.
  std::unique_ptr<RayScene> rays;
  std::vector<Vec3> changing_middles;  ///< Centres of the objects that change their shape.
  std::unique_ptr<RayScene> foliage;   ///< Phantoms' foliage; occludes views; may be null.

  bool Transmits(const Face& face) const {
    return mesh_sides[face.mesh_side].transmittance != std::array<float, 3>{};
  }
  const Face& FaceOf(const RayHit& hit) const { return faces[first_face[hit.mesh] + hit.triangle]; }

  /// Index of a patch's first surface sample, and the number of them.
  std::uint32_t FirstSample(std::uint32_t patch) const {
    return patch == 0 ? 0 : surface_sample_ends[patch - 1];
  }
  std::uint32_t SampleCount(std::uint32_t patch) const {
    return surface_sample_ends[patch] - FirstSample(patch);
  }

  /// Selects one of a patch's surface samples by a hash.
  const PatchSample& AnyPatchSample(std::uint32_t patch, std::uint32_t hash) const {
    return surface_samples[FirstSample(patch) + hash % SampleCount(patch)];
  }

  /// One flag per patch.
  std::vector<std::uint8_t> ArePhantoms() const {
    std::vector<std::uint8_t> are;
    are.reserve(patch_count);
    for (const MeshSide& mesh_side : mesh_sides) {
      are.insert(are.end(), mesh_side.patch_count, mesh_side.mesh.is_phantom ? 1 : 0);
    }
    return are;
  }

  /// Computes the light at a mesh side's vertices from that of all patches.
  std::vector<std::array<float, 3>> VertexLight(
      const MeshSide& mesh_side, std::span<const std::array<float, 3>> patch_light) const;

  static Result<PatchScene> Create(const std::vector<PlacedModel>& models,
                                   const LightSolverOptions& options);
};

}  // namespace pleinair::compositor
