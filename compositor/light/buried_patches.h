#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "compositor/light/final_gather.h"
#include "compositor/light/patch_scene.h"

namespace pleinair::compositor {

/// Calls visit(patch, first_hit, last_hit) for each patch of a block.
template <typename Visit>
void ForEachPatch(const FinalGather& gathered, std::size_t block_index, const Visit& visit) {
  const FinalGather::Block& block = gathered.blocks[block_index];
  const FinalGather::Hit* first = block.hits.data();
  auto patch = static_cast<std::uint32_t>(block_index) * FinalGather::kBlockSize;
  for (const std::uint32_t end : block.ends) {
    const FinalGather::Hit* last = block.hits.data() + end;
    visit(patch++, first, last);
    first = last;
  }
}

/// The patches at the corners of the face that a ray hit, on the hit side.
inline std::array<std::uint32_t, 3> CornersOf(const PatchScene::Face& face,
                                              const FinalGather::Hit& hit) {
  std::array<std::uint32_t, 3> corners = face.patches;
  if (hit.back != 0) {
    for (std::uint32_t& corner : corners) corner += face.back_offset;
  }
  return corners;
}

/// The same on the other side of an open surface.
inline std::array<std::uint32_t, 3> OtherCornersOf(const PatchScene::Face& face,
                                                   FinalGather::Hit hit) {
  hit.back = hit.back == 0 ? 1 : 0;
  return CornersOf(face, hit);
}

/// Flags patches that lie inside a body or face the earth. Index 0: with the virtual objects, 1:
/// phantoms alone.
std::array<std::vector<std::uint8_t>, 2> FindBuriedPatches(const PatchScene& scene,
                                                           const FinalGather& gathered,
                                                           int threads);

/// Calls visit(from, to) for each pair of neighbouring patches of a mesh side, in both directions.
template <typename Visit>
void ForEachNeighbour(const PatchScene::MeshSide& mesh_side, const Visit& visit) {
  if (mesh_side.groups) {
    for (const auto& [a, b] : mesh_side.groups->links) {
      visit(a, b);
      visit(b, a);
    }
    return;
  }
  for (std::size_t i = 0; i + 2 < mesh_side.mesh.indices.size(); i += 3) {
    for (int e = 0; e < 6; ++e) {
      visit(mesh_side.mesh.indices[i + e % 3],
            mesh_side.mesh.indices[i + (e + (e < 3 ? 1 : 2)) % 3]);
    }
  }
}

/// Gives buried patches the mean of their neighbours outside, ring after ring.
template <std::size_t N>
void FillFromNeighbours(const PatchScene& scene, const std::vector<std::uint8_t>& buried_patches,
                        std::vector<std::array<float, N>>* values) {
  for (const PatchScene::MeshSide& mesh_side : scene.mesh_sides) {
    const std::uint32_t base = mesh_side.first_patch;
    const std::size_t size = mesh_side.patch_count;
    std::vector<std::uint8_t> missing(buried_patches.begin() + base,
                                      buried_patches.begin() + base + size);
    std::vector<std::array<float, N + 1>> sums(size);
    for (bool progress = std::find(missing.begin(), missing.end(), 1) != missing.end(); progress;) {
      std::fill(sums.begin(), sums.end(), std::array<float, N + 1>{});
      ForEachNeighbour(mesh_side, [&](std::uint32_t from, std::uint32_t to) {
        if (missing[from] != 0 || missing[to] == 0) return;
        for (std::size_t c = 0; c < N; ++c) sums[to][c] += (*values)[base + from][c];
        ++sums[to][N];
      });
      progress = false;
      for (std::size_t v = 0; v < size; ++v) {
        if (missing[v] == 0 || sums[v][N] == 0.0F) continue;
        for (std::size_t c = 0; c < N; ++c) (*values)[base + v][c] = sums[v][c] / sums[v][N];
        missing[v] = 0;
        progress = true;
      }
    }
  }
}

}  // namespace pleinair::compositor
