#include "compositor/light/final_gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/cosine_spread.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

using Hit = FinalGather::Hit;

// Real ground comes in layers (a lawn's mesh side over paving); the gaps between them are
// invisible.
constexpr double kLayerGapM = 0.02;
constexpr std::uint32_t kSampleSalt = 0x5B, kTreesSalt = 0x7E;
// Number of rays that test whether a lower side, such as the ground's, sees the land alone.
constexpr std::uint32_t kLandRays = 32;

class Gatherer {
 public:
  /// Without `sky`, rays record sky patches; without `to_sun`, the sun is not sampled.
  /// `sun_transmittance`: null without trees.
  Gatherer(const PatchScene& scene, const SkyTable* sky, const SkyPatches* patches,
           std::optional<Vec3> to_sun, const SunTransmittanceMap* sun_transmittance, int rays)
      : scene_(scene),
        sky_(sky),
        patches_(patches),
        sunlight_(sun_transmittance),
        spread_(static_cast<std::uint32_t>(rays)) {
    if (to_sun) sun_frame_.emplace(*to_sun);
    is_phantom_ = scene.ArePhantoms();
    for (const PatchScene::MeshSide& mesh_side : scene.mesh_sides) {
      has_twin_.insert(has_twin_.end(), mesh_side.patch_count, mesh_side.twin >= 0);
    }
  }

  FinalGather::Patch GatherPatch(std::uint32_t patch, FinalGather::Block* block) const {
    FinalGather::Patch light;
    const bool land_alone = scene_.SampleCount(patch) == 1 && is_phantom_[patch] != 0 &&
                            has_twin_[patch] != 0 &&
                            SeesLandAlone(scene_.AnyPatchSample(patch, 0), patch);
    const CosineSpread::Shift shift = CosineSpread::ShiftOf(patch);
    for (std::uint32_t first = 0; first < spread_.count(); first += RayPacket::kSize) {
      GatherPacket(patch, shift, first, land_alone, &light, block);
    }
    return light;
  }

 private:
  /// Sets of rays of a packet: one bit per ray.
  using Rays = unsigned;
  static bool Has(Rays rays, unsigned i) { return (rays >> i & 1U) != 0; }

  /// What rays of a packet see.
  struct Seen {
    Rays hit = 0;
    std::array<RayHit, RayPacket::kSize> hits;
    Rays with = 0, without = 0;  ///< Seen with the virtual objects present, with phantoms alone.
    std::array<Hit, RayPacket::kSize> records{};
    RayPacket to_sun;
    Rays facing_sun = 0;  ///< And not behind trees.
  };

  void GatherPacket(std::uint32_t patch, const CosineSpread::Shift& shift, std::uint32_t first,
                    bool land_alone, FinalGather::Patch* light, FinalGather::Block* block) const {
    const bool phantom = is_phantom_[patch] != 0;
    const unsigned count = std::min<unsigned>(RayPacket::kSize, spread_.count() - first);
    const Rays all = (1U << count) - 1U;
    RayPacket rays;
    for (unsigned i = 0; i < count; ++i) {
      // A patch with many surface samples gathers their mean.
      const PatchScene::PatchSample& surface_sample =
          scene_.AnyPatchSample(patch, Hash(Hash(patch, spread_.RayAt(first + i)), kSampleSalt));
      const auto& [x, y, z] = surface_sample.normal;
      rays.origins[i] = surface_sample.origin;
      rays.directions[i] = spread_.Direction(TangentFrame(Normalized({x, y, z})), first + i, shift);
    }
    Seen seen, behind;  // Behind virtual objects that phantoms see.
    if (!land_alone) {
      seen.hit = scene_.rays->Intersect(RayTargets::kEverything, rays, all, &seen.hits);
    }
    seen.with = seen.hit;
    Rays on_phantoms = 0;
    for (unsigned i = 0; i < count; ++i) {
      if (Has(seen.hit, i) &&
          scene_.mesh_sides[scene_.FaceOf(seen.hits[i]).mesh_side].mesh.is_phantom) {
        on_phantoms |= 1U << i;
      }
    }
    const Rays on_objects = phantom ? seen.hit & ~on_phantoms : 0;
    if (phantom) seen.without = on_phantoms;
    behind.hit = scene_.rays->Intersect(RayTargets::kPhantoms, rays, on_objects, &behind.hits);
    behind.without = behind.hit;
    for (unsigned i = 0; i < count; ++i) {
      if (!Has(seen.hit, i)) {
        AddSky(rays.directions[i], true, phantom, light, block);
      } else if (Has(on_objects & ~behind.hit, i)) {
        AddSky(rays.directions[i], false, true, light, block);
      }
    }
    for (Seen* of : {&seen, &behind}) {
      Record(patch, first, rays, of, light);
      AddSunlight(of);
      for (unsigned i = 0; i < count; ++i) {
        if (Has(of->hit, i)) block->hits.push_back(of->records[i]);
      }
    }
  }

  bool IsBelowHorizon(Vec3 direction) const {
    return sky_ != nullptr ? sky_->SineElevation(direction) <= 0.0
                           : patches_->At(direction) == patches_->land();
  }

  bool SeesLandAlone(const PatchScene::PatchSample& surface_sample, std::uint32_t patch) const {
    const TangentFrame frame(
        Normalized({surface_sample.normal[0], surface_sample.normal[1], surface_sample.normal[2]}));
    if (!IsBelowHorizon(frame.normal)) return false;
    for (std::uint32_t i = 0; i < kLandRays; ++i) {
      const Vec3 direction = CosineDirection(frame, ShiftedHammersley(i, kLandRays, patch));
      if (!IsBelowHorizon(direction) ||
          scene_.rays->Occluded(RayTargets::kEverything, surface_sample.origin, direction)) {
        return false;
      }
    }
    return true;
  }

  void AddSky(Vec3 direction, bool with, bool without, FinalGather::Patch* light,
              FinalGather::Block* block) const {
    bool above = false;
    std::array<float, 3> radiance{};
    if (sky_ != nullptr) {
      radiance = sky_->Radiance(direction);
      above = sky_->SineElevation(direction) > 0.0;
    } else {
      const int patch = patches_->At(direction);
      above = patch != patches_->land();
      FinalGather::Escape escape{};
      escape.patch = static_cast<std::uint16_t>(patch) & ((1U << 14) - 1);
      escape.with = with;
      escape.without = without;
      block->escapes.push_back(escape);
    }
    for (const int k : {0, 1}) {
      if (!(k == 0 ? with : without)) continue;
      for (int c = 0; c < 3; ++c) light->sky[k][c] += radiance[c];
      ++(above ? light->sky_rays : light->land_rays)[k];
    }
  }

  /// Makes the records, without the sun. Hits on the inside of bodies are removed: they gather no
  /// light.
  void Record(std::uint32_t patch, std::uint32_t first, const RayPacket& rays, Seen* seen,
              FinalGather::Patch* light) const {
    for (unsigned i = 0; i < RayPacket::kSize; ++i) {
      if (!Has(seen->hit, i)) continue;
      const RayHit& hit = seen->hits[i];
      const PatchScene::Face& face = scene_.FaceOf(hit);
      const bool inside = hit.back && face.back_offset == 0;
      for (const int k : {0, 1}) {
        if (!Has(k == 0 ? seen->with : seen->without, i)) continue;
        ++light->hit_rays[k];
        if (inside) ++light->buried_rays[k];
      }
      if (inside) {
        seen->hit &= ~(1U << i);
        continue;
      }
      Hit record{};
      record.face = static_cast<std::uint32_t>(&face - scene_.faces.data()) & ((1U << 26) - 1);
      record.with = Has(seen->with, i);
      record.without = Has(seen->without, i);
      record.back = hit.back;
      // Without the objects there are phantoms alone.
      record.close = record.without != 0 && hit.distance_m < kLayerGapM;
      record.u = Quantized(hit.u);
      record.v = Quantized(hit.v);
      seen->records[i] = record;
      FaceSun(patch, spread_.RayAt(first + i),
              rays.origins[i] + rays.directions[i] * hit.distance_m, face, i, seen);
    }
  }

  /// Sets the ray from a hit's point to the sun, if the surface there faces it. The ray sees the
  /// sun where the sun transmittance exceeds a number that is evenly distributed over a patch's
  /// rays.
  void FaceSun(std::uint32_t patch, std::uint32_t ray, Vec3 surface, const PatchScene::Face& face,
               unsigned i, Seen* seen) const {
    if (!sun_frame_) return;
    Vec3 normal = seen->hits[i].back ? -face.normal : face.normal;
    double facing = Dot(normal, sun_frame_->normal);
    if (facing < 0.0 && scene_.Transmits(face)) {
      normal = -normal;
      facing = -facing;
    }
    if (facing <= 0.0) return;
    const Vec3 point = surface + normal * kRayOffset_m;
    if (sunlight_ != nullptr) {
      // In any order of the rays (multiples of the golden ratio).
      const double turn = UnitFromHash(Hash(patch, kTreesSalt)) + ray * (std::numbers::phi - 1.0);
      // At a transmittance of one half, every second ray sees the full sun.
      if (turn - std::floor(turn) >= sunlight_->At(point)) return;
    }
    const std::uint32_t seed = Hash(patch, ray);
    seen->to_sun.origins[i] = point;
    seen->to_sun.directions[i] =
        SunDiscDirection(*sun_frame_, {UnitFromHash(Hash(seed, 1)), UnitFromHash(Hash(seed, 2))});
    seen->facing_sun |= 1U << i;
  }

  /// Traces the rays to the sun.
  void AddSunlight(Seen* seen) const {
    const Rays with = seen->facing_sun & seen->with;
    const Rays lit_with =
        with & ~scene_.rays->Occluded(RayTargets::kEverything, seen->to_sun, with);
    const Rays without = seen->facing_sun & seen->without & ~lit_with;
    const Rays lit_without =
        lit_with | (without & ~scene_.rays->Occluded(RayTargets::kPhantoms, seen->to_sun, without));
    for (unsigned i = 0; i < RayPacket::kSize; ++i) {
      seen->records[i].sun_with = Has(lit_with, i);
      seen->records[i].sun_without = Has(lit_without, i);
    }
  }

  static std::uint16_t Quantized(float weight) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(weight, 0.0F, 1.0F) * 65535.0F));
  }

  const PatchScene& scene_;
  const SkyTable* sky_;
  const SkyPatches* patches_;
  const SunTransmittanceMap* sunlight_;
  std::optional<TangentFrame> sun_frame_;
  CosineSpread spread_;
  std::vector<std::uint8_t> is_phantom_, has_twin_;  ///< One entry per patch.
};

std::size_t BlockCount(std::uint32_t patches) {
  return (patches + FinalGather::kBlockSize - 1) / FinalGather::kBlockSize;
}

FinalGather GatherWith(const PatchScene& scene, const Gatherer& gatherer, int rays, int threads,
                       const std::atomic<bool>* stop) {
  FinalGather gathered;
  gathered.rays = rays;
  gathered.patches.resize(scene.patch_count);
  gathered.blocks.resize(BlockCount(scene.patch_count));
  ParallelFor(gathered.blocks.size(), threads, [&](std::size_t index) {
    if (stop != nullptr && *stop) return;
    FinalGather::Block& block = gathered.blocks[index];
    block.hits.reserve(std::size_t{FinalGather::kBlockSize} * static_cast<std::size_t>(rays));
    const auto first = static_cast<std::uint32_t>(index) * FinalGather::kBlockSize;
    const std::uint32_t last = std::min(first + FinalGather::kBlockSize, scene.patch_count);
    for (std::uint32_t patch = first; patch < last; ++patch) {
      gathered.patches[patch] = gatherer.GatherPatch(patch, &block);
      block.ends.push_back(static_cast<std::uint32_t>(block.hits.size()));
      block.escape_ends.push_back(static_cast<std::uint32_t>(block.escapes.size()));
    }
    block.hits.shrink_to_fit();
    block.escapes.shrink_to_fit();
  });
  return gathered;
}

}  // namespace

FinalGather Gather(const PatchScene& scene, const SkyTable& sky, Vec3 to_sun,
                   const SunTransmittanceMap& sun_transmittance, int rays, int threads) {
  const SunTransmittanceMap* const trees =
      sun_transmittance.share.empty() ? nullptr : &sun_transmittance;
  FinalGather gathered = GatherWith(scene, Gatherer(scene, &sky, nullptr, to_sun, trees, rays),
                                    rays, threads, nullptr);
  gathered.sunlight_from_land = sky.sunlight_from_land();
  return gathered;
}

FinalGather GatherPatches(const PatchScene& scene, const SkyPatches& patches, int rays, int threads,
                          const std::atomic<bool>* stop) {
  return GatherWith(scene, Gatherer(scene, nullptr, &patches, std::nullopt, nullptr, rays), rays,
                    threads, stop);
}

}  // namespace pleinair::compositor
