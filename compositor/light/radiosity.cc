#include "compositor/light/radiosity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/buried_patches.h"
#include "compositor/light/patch_scene.h"

namespace pleinair::compositor {
namespace {

using Hit = FinalGather::Hit;
using PatchValues = std::vector<std::array<float, 3>>;

/// Adds to `last` of the virtual objects the reflections that were not followed. They form a
/// geometric series with the scene's mean ratio of the last two increments. The ratio of a single
/// patch would be no estimate: the patch may see surfaces that see sunlit ones, but no sunlit one.
/// `first` and `second` have two reflections and one less than `last`.
void Extrapolate(const std::vector<std::uint8_t>& is_phantom, const PatchValues& first,
                 const PatchValues& second, PatchValues* last) {
  // Reached where surfaces are white and see nothing else.
  constexpr double kMaxRatio = 0.9;
  for (std::size_t c = 0; c < 3; ++c) {
    double earlier = 0.0, added = 0.0;
    for (std::size_t patch = 0; patch < last->size(); ++patch) {
      earlier += second[patch][c] - first[patch][c];
      added += (*last)[patch][c] - second[patch][c];
    }
    if (!(earlier > 0.0 && added > 0.0)) continue;
    const double ratio = std::min(added / earlier, kMaxRatio);
    const auto share = static_cast<float>(ratio / (1.0 - ratio));
    for (std::size_t patch = 0; patch < last->size(); ++patch) {
      float& value = (*last)[patch][c];
      if (is_phantom[patch] == 0) value += share * std::max(0.0F, value - second[patch][c]);
    }
  }
}

/// The part of the objects' case that is not reflected sunlight.
PatchValues OfSky(const PatchLight& light) {
  PatchValues values = light.irradiance[0];
  for (std::size_t patch = 0; patch < values.size(); ++patch) {
    for (std::size_t c = 0; c < 3; ++c) values[patch][c] -= light.reflected[0][patch][c];
  }
  return values;
}

/// Sky and sun are extrapolated apart, so that their light adds up.
void AddUnfollowed(const PatchScene& scene, const PatchLight& before, const PatchLight& previous,
                   PatchLight* light) {
  const std::vector<std::uint8_t> is_phantom = scene.ArePhantoms();
  PatchValues of_sky = OfSky(*light);
  Extrapolate(is_phantom, OfSky(before), OfSky(previous), &of_sky);
  Extrapolate(is_phantom, before.reflected[0], previous.reflected[0], &light->reflected[0]);
  for (std::size_t patch = 0; patch < of_sky.size(); ++patch) {
    if (is_phantom[patch] != 0) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      light->irradiance[0][patch][c] = of_sky[patch][c] + light->reflected[0][patch][c];
    }
  }
}

}  // namespace

PatchLight SolveRadiosity(const PatchScene& scene, const FinalGather& gathered,
                          const std::array<float, 3>& sun_irradiance, Vec3 to_sun, int bounces,
                          int threads) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const auto inside = FindBuriedPatches(scene, gathered, threads);
  const auto sunlit_land = [&](std::uint32_t patch, int k) {
    std::array<float, 3> sum = gathered.sunlight_from_land;
    for (float& value : sum) value *= static_cast<float>(gathered.patches[patch].land_rays[k]);
    return sum;
  };
  PatchLight light;
  for (const int k : {0, 1}) {
    light.irradiance[k].resize(scene.patch_count);
    light.reflected[k].resize(scene.patch_count);
    for (std::uint32_t v = 0; v < scene.patch_count; ++v) {
      const float weight = gathered.RayWeight(v, k);
      for (int c = 0; c < 3; ++c) {
        light.irradiance[k][v][c] = gathered.patches[v].sky[k][c] * weight;
        light.reflected[k][v][c] = sunlit_land(v, k)[c] * weight;
      }
    }
    FillFromNeighbours(scene, inside[k], &light.irradiance[k]);
    FillFromNeighbours(scene, inside[k], &light.reflected[k]);
  }
  PatchLight previous, before;
  for (int bounce = 0; bounce < bounces; ++bounce) {
    before = std::exchange(previous, light);
    ParallelFor(gathered.blocks.size(), threads, [&](std::size_t block) {
      ForEachPatch(gathered, block, [&](std::uint32_t patch, const Hit* first, const Hit* last) {
        auto sum = gathered.patches[patch].sky;
        std::array of_sun{sunlit_land(patch, 0), sunlit_land(patch, 1)};
        for (const Hit* hit = first; hit != last; ++hit) {
          const PatchScene::Face& face = scene.faces[hit->face];
          const auto corners = CornersOf(face, *hit);
          const float u = static_cast<float>(hit->u) / 65535.0F;
          const float v = static_cast<float>(hit->v) / 65535.0F;
          const PatchScene::MeshSide& side = scene.mesh_sides[face.mesh_side];
          const bool transmits = scene.Transmits(face);
          const auto behind = transmits ? OtherCornersOf(face, *hit) : corners;
          const double facing = Dot(face.normal, to_sun) * (hit->back != 0 ? -1.0 : 1.0);
          // What the sun shines on: this side, or the other of a surface that transmits light.
          const auto& sunlit = transmits && facing < 0.0 ? side.transmittance : side.albedo;
          const auto cosine = static_cast<float>(std::fabs(facing));
          for (const int k : {0, 1}) {
            if ((k == 0 ? hit->with : hit->without) == 0) continue;
            const float sun = (k == 0 ? hit->sun_with : hit->sun_without) != 0 ? cosine : 0.0F;
            const auto reflect = [&](const std::vector<std::array<float, 3>>& irradiance,
                                     std::array<float, 3>* radiance) {
              const auto ambient = [&](const std::array<std::uint32_t, 3>& at, int c) {
                return (1.0F - u - v) * irradiance[at[0]][c] + u * irradiance[at[1]][c] +
                       v * irradiance[at[2]][c];
              };
              if (!transmits) {
                for (int c = 0; c < 3; ++c) {
                  (*radiance)[c] +=
                      side.albedo[c] / kPi * (sun_irradiance[c] * sun + ambient(corners, c));
                }
                return;
              }
              for (int c = 0; c < 3; ++c) {
                (*radiance)[c] +=
                    (sunlit[c] * sun_irradiance[c] * sun + side.albedo[c] * ambient(corners, c) +
                     side.transmittance[c] * ambient(behind, c)) /
                    kPi;
              }
            };
            reflect(previous.irradiance[k], &sum[k]);
            reflect(previous.reflected[k], &of_sun[k]);
          }
        }
        for (const int k : {0, 1}) {
          const float weight = gathered.RayWeight(patch, k);
          for (int c = 0; c < 3; ++c) {
            light.irradiance[k][patch][c] = sum[k][c] * weight;
            light.reflected[k][patch][c] = of_sun[k][c] * weight;
          }
        }
      });
    });
    for (const int k : {0, 1}) {
      FillFromNeighbours(scene, inside[k], &light.irradiance[k]);
      FillFromNeighbours(scene, inside[k], &light.reflected[k]);
    }
  }
  if (bounces >= 2) AddUnfollowed(scene, before, previous, &light);
  return light;
}

}  // namespace pleinair::compositor
