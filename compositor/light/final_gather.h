#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "compositor/light/patch_scene.h"
#include "compositor/light/sky_patches.h"
#include "compositor/light/sky_table.h"
#include "compositor/light/sun_transmittance_map.h"

namespace pleinair::compositor {

/// What the rays of every patch met, so that reflections can be followed without tracing again.
struct FinalGather {
  /// A surface that a patch sees, in 8 bytes: there are millions.
  struct Hit {
    std::uint32_t face : 26;
    std::uint32_t with : 1;         ///< Seen with the virtual objects there.
    std::uint32_t without : 1;      ///< Seen with the phantoms alone.
    std::uint32_t sun_with : 1;     ///< The sun shines on it, with the virtual objects there.
    std::uint32_t sun_without : 1;  ///< The same with the phantoms alone.
    std::uint32_t back : 1;
    std::uint32_t close : 1;  ///< Nearer than layers of one real surface lie apart.
    std::uint16_t u, v;       ///< Barycentric, 65535 = 1.
  };
  static_assert(sizeof(Hit) == 8);

  /// Index 0: with the virtual objects, 1: phantoms alone.
  struct Patch {
    std::array<std::array<float, 3>, 2> sky{};   ///< Sum of radiances of rays that left.
    std::array<std::uint32_t, 2> sky_rays{};     ///< How many of them went above the horizon.
    std::array<std::uint32_t, 2> buried_rays{};  ///< Rays that met the inside of a body.
    std::array<std::uint32_t, 2> hit_rays{};
  };

  /// A ray that left for the sky, where it is told by patches.
  struct Escape {
    std::uint16_t patch : 14;
    std::uint16_t with : 1, without : 1;
  };
  static_assert(sizeof(Escape) == 2);

  struct Block {
    std::vector<Hit> hits;
    std::vector<std::uint32_t> ends;  ///< One past each patch's last hit.
    std::vector<Escape> escapes;      ///< Of GatherPatches() alone.
    std::vector<std::uint32_t> escape_ends;
  };

  static constexpr std::uint32_t kBlockSize = 256;  ///< Patches a block.
  int rays = 0;                                     ///< A patch.
  std::vector<Patch> patches;
  std::vector<Block> blocks;
};

/// Sends `rays` cosine-weighted rays from every patch. A ray whose nearest surface is
/// a phantom's serves both cases, so that they differ by what the objects change and not by noise.
/// `sunlight`: how much of the sun trees leave to what the rays meet.
FinalGather Gather(const PatchScene& scene, const SkyTable& sky, Vec3 to_sun,
                   const SunTransmittanceMap& sun_transmittance, int rays, int threads);

/// The same for whatever sky: rays that leave are told by the patch that they leave through, and no
/// sun is asked for. Once `stop` is set it ends soon, and what it gives is of no use.
FinalGather GatherPatches(const PatchScene& scene, const SkyPatches& patches, int rays, int threads,
                          const std::atomic<bool>* stop = nullptr);

/// Irradiance on every patch after `bounces` reflections; [0]: with the virtual objects, [1]:
/// phantoms alone (meaningless for patches of objects). Patches that lie inside a body, such as
/// the ground's under a wall, take their neighbours' values, lest they darken them.
struct PatchLight {
  std::array<std::vector<std::array<float, 3>>, 2> irradiance;
};
PatchLight SolveRadiosity(const PatchScene& scene, const FinalGather& gathered,
                          const std::array<float, 3>& sun_irradiance, Vec3 to_sun, int bounces,
                          int threads);

}  // namespace pleinair::compositor
