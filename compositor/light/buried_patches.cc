#include "compositor/light/buried_patches.h"

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

/// A patch is buried if more than this fraction of its rays hit the inside of bodies. Outside, the
/// fraction is 0, except for rays that slip through an edge; inside, it is a half or more.
constexpr double kBuriedShare = 0.25;
// The same for a patch that gathers over an area, some of which may be buried.
constexpr double kBuriedShareOfArea = 0.75;

/// Flags sides of phantoms that face the earth: they see neither the sky nor much else.
std::vector<std::uint8_t> EarthwardPatches(const PatchScene& scene, const FinalGather& gathered) {
  std::vector<std::uint8_t> earthward(scene.patch_count);
  const double rays = gathered.rays;
  for (const PatchScene::MeshSide& mesh_side : scene.mesh_sides) {
    if (mesh_side.twin < 0 || !mesh_side.mesh.is_phantom) continue;
    for (std::uint32_t i = 0; i < mesh_side.patch_count; ++i) {
      const FinalGather::Patch& light = gathered.patches[mesh_side.first_patch + i];
      earthward[mesh_side.first_patch + i] =
          light.sky_rays[1] < 0.02 * rays && light.hit_rays[1] < 0.3 * rays;
    }
  }
  return earthward;
}

}  // namespace

std::array<std::vector<std::uint8_t>, 2> FindBuriedPatches(const PatchScene& scene,
                                                           const FinalGather& gathered,
                                                           int threads) {
  const std::vector<std::uint8_t> earthward = EarthwardPatches(scene, gathered);
  std::array<std::vector<std::uint8_t>, 2> buried_patches;
  for (auto& flags : buried_patches) flags.resize(scene.patch_count);
  ParallelFor(gathered.blocks.size(), threads, [&](std::size_t block) {
    ForEachPatch(
        gathered, block,
        [&](std::uint32_t patch, const FinalGather::Hit* first, const FinalGather::Hit* last) {
          std::array<std::uint32_t, 2> count = gathered.patches[patch].buried_rays;
          const double share = scene.SampleCount(patch) == 1 ? kBuriedShare : kBuriedShareOfArea;
          for (const FinalGather::Hit* hit = first; hit != last; ++hit) {
            if (hit->back == 0 && hit->close == 0) continue;
            const auto corners = CornersOf(scene.faces[hit->face], *hit);
            const bool buried =
                hit->close != 0 || (earthward[corners[0]] != 0 && earthward[corners[1]] != 0 &&
                                    earthward[corners[2]] != 0);
            if (!buried) continue;
            count[0] += hit->with;
            count[1] += hit->without;
          }
          for (const int k : {0, 1}) {
            buried_patches[k][patch] = count[k] > share * gathered.rays;
          }
        });
  });
  return buried_patches;
}

}  // namespace pleinair::compositor
