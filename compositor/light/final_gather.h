#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <numbers>
#include <vector>

#include "compositor/light/patch_scene.h"
#include "compositor/light/sky_patches.h"
#include "compositor/light/sky_table.h"
#include "compositor/light/sun_transmittance_map.h"

namespace pleinair::compositor {

/// Results of the rays of all patches, so that radiosity iterations trace no rays again.
struct FinalGather {
  /// A surface that a patch sees. It takes 8 bytes because there are millions.
  struct Hit {
    std::uint32_t face : 26;
    std::uint32_t with : 1;         ///< Seen with the virtual objects present.
    std::uint32_t without : 1;      ///< Seen with the phantoms alone.
    std::uint32_t sun_with : 1;     ///< Sunlit with the virtual objects present.
    std::uint32_t sun_without : 1;  ///< Sunlit with the phantoms alone.
                                    ///< Where light is transmitted: on either side.
    std::uint32_t back : 1;
    std::uint32_t close : 1;  ///< Nearer than the layers of one real surface are apart.
    std::uint16_t u, v;       ///< Barycentric coordinates, 65535 = 1.
  };
  static_assert(sizeof(Hit) == 8);

  /// Index 0: with the virtual objects, 1: phantoms alone.
  struct Patch {
    std::array<std::array<float, 3>, 2> sky{};   ///< Sum of the radiances of escaped rays.
    std::array<std::uint32_t, 2> sky_rays{};     ///< Number of escaped rays above the horizon.
    std::array<std::uint32_t, 2> land_rays{};    ///< Number of escaped rays below the horizon.
    std::array<std::uint32_t, 2> buried_rays{};  ///< Rays that hit the inside of a body.
    std::array<std::uint32_t, 2> hit_rays{};
  };

  /// A ray that escaped to the sky, where the sky is divided into patches.
  struct Escape {
    std::uint16_t patch : 14;
    std::uint16_t with : 1, without : 1;
  };
  static_assert(sizeof(Escape) == 2);

  struct Block {
    std::vector<Hit> hits;
    std::vector<std::uint32_t> ends;  ///< One past each patch's last hit.
    std::vector<Escape> escapes;      ///< From GatherPatches() only.
    std::vector<std::uint32_t> escape_ends;
  };

  static constexpr std::uint32_t kBlockSize = 256;  ///< Patches per block.
  int rays = 0;                                     ///< Rays per patch.
  std::array<float, 3> sunlight_from_land{};        ///< SkyTable::sunlight_from_land().
  std::vector<Patch> patches;
  std::vector<Block> blocks;

  /// Irradiance per radiance of one ray. Rays that hit the inside of a body take no part: some of
  /// the patch lies inside, and the rest of it represents it.
  float RayWeight(std::uint32_t patch, int k) const {
    const std::uint32_t buried = patches[patch].buried_rays[static_cast<std::size_t>(k)];
    const std::uint32_t outside = static_cast<std::uint32_t>(rays) - buried;
    return std::numbers::pi_v<float> / static_cast<float>(std::max(1U, outside));
  }
};

/// Traces `rays` cosine-weighted rays from every patch. A ray that hits a phantom first serves both
/// cases. They therefore differ by the objects' effect and not by noise. Trees attenuate the sun at
/// the hit points by `sun_transmittance`.
FinalGather Gather(const PatchScene& scene, const SkyTable& sky, Vec3 to_sun,
                   const SunTransmittanceMap& sun_transmittance, int rays, int threads);

/// Gathers for any sky: an escaped ray records the sky patch through which it leaves. The sun is
/// not sampled. The function returns soon after `stop` is set; its result is then invalid.
FinalGather GatherPatches(const PatchScene& scene, const SkyPatches& patches, int rays, int threads,
                          const std::atomic<bool>* stop = nullptr);

}  // namespace pleinair::compositor
