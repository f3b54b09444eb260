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
void ForEachPatch(const GatheredLight& gathered, std::size_t block_index, const Visit& visit) {
  const GatheredLight::Block& block = gathered.blocks[block_index];
  const GatheredLight::Hit* first = block.hits.data();
  auto patch = static_cast<std::uint32_t>(block_index) * GatheredLight::kBlockSize;
  for (const std::uint32_t end : block.ends) {
    const GatheredLight::Hit* last = block.hits.data() + end;
    visit(patch++, first, last);
    first = last;
  }
}

/// The patches at the corners of the face that a ray hit, on the side that it hit.
inline std::array<std::uint32_t, 3> CornersOf(const LightScene::Face& face,
                                              const GatheredLight::Hit& hit) {
  std::array<std::uint32_t, 3> corners = face.patches;
  if (hit.back != 0) {
    for (std::uint32_t& corner : corners) corner += face.back_offset;
  }
  return corners;
}

/// Patches that lie inside a body or in the earth; [0]: with the virtual objects, [1]: phantoms
/// alone.
std::array<std::vector<std::uint8_t>, 2> InsidePatches(const LightScene& scene,
                                                       const GatheredLight& gathered, int threads);

/// Calls visit(from, to) for the neighbours among a sheet's patches, either way.
template <typename Visit>
void ForEachNeighbour(const LightScene::Sheet& sheet, const Visit& visit) {
  if (sheet.groups) {
    for (const auto& [a, b] : sheet.groups->links) {
      visit(a, b);
      visit(b, a);
    }
    return;
  }
  for (std::size_t i = 0; i + 2 < sheet.mesh.indices.size(); i += 3) {
    for (int e = 0; e < 6; ++e) {
      visit(sheet.mesh.indices[i + e % 3], sheet.mesh.indices[i + (e + (e < 3 ? 1 : 2)) % 3]);
    }
  }
}

/// Gives patches inside bodies the mean of their neighbours outside, ring after ring.
template <std::size_t N>
void FillFromNeighbours(const LightScene& scene, const std::vector<std::uint8_t>& inside,
                        std::vector<std::array<float, N>>* values) {
  for (const LightScene::Sheet& sheet : scene.sheets) {
    const std::uint32_t base = sheet.first_patch;
    const std::size_t size = sheet.patch_count;
    std::vector<std::uint8_t> missing(inside.begin() + base, inside.begin() + base + size);
    std::vector<std::array<float, N + 1>> sums(size);
    for (bool progress = std::find(missing.begin(), missing.end(), 1) != missing.end(); progress;) {
      std::fill(sums.begin(), sums.end(), std::array<float, N + 1>{});
      ForEachNeighbour(sheet, [&](std::uint32_t from, std::uint32_t to) {
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
