#include "compositor/light_inside.h"

#include "compositor/parallel_for.h"

namespace pleinair::compositor {
namespace {

/// Above this share of rays that meet the inside of bodies a vertex is itself inside: from outside
/// the share is 0 but for rays that slip through an edge, from inside a half or more.
constexpr double kInsideShare = 0.25;

/// Sides of phantoms that look into the earth: they see neither sky nor, mostly, anything else.
std::vector<std::uint8_t> EarthwardVertices(const LightScene& scene,
                                            const GatheredLight& gathered) {
  std::vector<std::uint8_t> earthward(scene.vertex_count);
  const double rays = gathered.rays_per_vertex;
  for (const LightScene::Sheet& sheet : scene.sheets) {
    if (sheet.twin < 0 || !sheet.mesh.is_phantom) continue;
    for (std::uint32_t i = 0; i < sheet.mesh.positions.size(); ++i) {
      const GatheredLight::Vertex& light = gathered.vertices[sheet.first_vertex + i];
      earthward[sheet.first_vertex + i] =
          light.sky_rays[1] < 0.02 * rays && light.hit_rays[1] < 0.3 * rays;
    }
  }
  return earthward;
}

}  // namespace

std::array<std::vector<std::uint8_t>, 2> InsideVertices(const LightScene& scene,
                                                        const GatheredLight& gathered,
                                                        int threads) {
  const std::vector<std::uint8_t> earthward = EarthwardVertices(scene, gathered);
  std::array<std::vector<std::uint8_t>, 2> inside;
  for (auto& flags : inside) flags.resize(scene.vertex_count);
  ParallelFor(gathered.blocks.size(), threads, [&](std::size_t block) {
    ForEachVertex(
        gathered, block,
        [&](std::uint32_t vertex, const GatheredLight::Hit* first, const GatheredLight::Hit* last) {
          std::array<std::uint32_t, 2> count = gathered.vertices[vertex].inside_rays;
          for (const GatheredLight::Hit* hit = first; hit != last; ++hit) {
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
            inside[k][vertex] = count[k] > kInsideShare * gathered.rays_per_vertex;
          }
        });
  });
  return inside;
}

}  // namespace pleinair::compositor
