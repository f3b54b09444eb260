#include "compositor/light/daylight/daylight_coefficients.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <numbers>
#include <span>
#include <vector>

#include "base/parallel_for.h"
#include "compositor/light/buried_patches.h"
#include "compositor/light/daylight/interreflection.h"
#include "compositor/light/final_gather.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

constexpr int kP = CoefficientMatrix::kPatches;
constexpr int kMaxReflections = 24;
// Takes about ten seconds on two processors.
constexpr std::uint32_t kRayBudget = 25'000'000;
constexpr std::uint32_t kMinRays = 32;
constexpr double kShareOfRays = 0.35;  // Share of the time, for the progress.

/// Increase it whenever the result for the same geometry and options changes: rays, sampling, sky
/// patches, reflections, codes. Otherwise cached results of an older version are used. The file's
/// header has its own version of the format.
constexpr std::uint64_t kMethodVersion = 3;

constexpr std::uint32_t kFineSalt = 0xF1;

using Straight = std::array<float, kP>;

class Transfer {
 public:
  Transfer(const PatchScene& scene, const FinalGather& gathered, const SkyPatches& patches,
           int threads)
      : scene_(scene),
        gathered_(gathered),
        patches_(patches),
        is_phantom_(scene.ArePhantoms()),
        threads_(threads),
        inside_(FindBuriedPatches(scene, gathered, threads)) {}

  /// Computes one chunk of patches in one case (0: with the objects, 1: without). Returns the
  /// number of reflections.
  int Follow(int chunk, int k, double convergence, CoefficientMatrix* matrix) {
    std::vector<Straight> straight = StraightLight(chunk, k);
    FillFromNeighbours(scene_, inside_[k], &straight);
    // The first iteration reflects the direct light; each later one reflects the previous result.
    std::vector<ChunkLight> arriving(straight.size()), sum(straight.size());
    for (std::size_t v = 0; v < straight.size(); ++v) {
      for (int c = 0; c < 3; ++c) {
        std::copy(straight[v].begin(), straight[v].end(), arriving[v].begin() + c * kP);
      }
    }
    double all = Total(arriving);
    int reflections = 0;
    while (reflections < kMaxReflections) {
      arriving = SolveRadiosity(arriving, k);
      FillFromNeighbours(scene_, inside_[k], &arriving);
      ++reflections;
      for (std::size_t v = 0; v < sum.size(); ++v) {
        for (std::size_t i = 0; i < arriving[v].size(); ++i) sum[v][i] += arriving[v][i];
      }
      const double added = Total(arriving);
      all += added;
      if (added <= convergence * all) break;
    }
    for (std::size_t v = 0; v < straight.size(); ++v) {
      matrix->Set(v, chunk, 0, straight[v]);
      for (int c = 0; c < 3; ++c) {
        matrix->Set(v, chunk, 1 + c, std::span<const float, kP>(sum[v].data() + c * kP, kP));
      }
    }
    return reflections;
  }

 private:
  static double Total(const std::vector<ChunkLight>& light) {
    double total = 0.0;
    for (const ChunkLight& values : light) {
      for (const float value : values) total += value;
    }
    return total;
  }

  /// A few of the gathered rays hit each of Tregenza's patches. Most finer patches are hit by none;
  /// a patch with the sun would then count fully or not at all. Each finer patch therefore has a
  /// ray of its own.
  std::vector<Straight> StraightLight(int chunk, int k) const {
    const bool fine = patches_.division() > 1;
    std::vector<Straight> straight(scene_.patch_count);
    ParallelFor(gathered_.blocks.size(), threads_, [&](std::size_t index) {
      const FinalGather::Block& block = gathered_.blocks[index];
      std::uint32_t at = 0;
      for (std::size_t i = 0; i < block.escape_ends.size(); ++i) {
        const auto patch = static_cast<std::uint32_t>(index * FinalGather::kBlockSize + i);
        Straight& light = straight[patch];
        const float weight = gathered_.RayWeight(patch, k);
        for (; at < block.escape_ends[i]; ++at) {
          const FinalGather::Escape& escape = block.escapes[at];
          if (escape.patch / kP != chunk || (k == 0 ? escape.with : escape.without) == 0) continue;
          if (fine && escape.patch != patches_.land()) continue;
          light[escape.patch % kP] += weight;
        }
        if (fine) {
          AddFinePatches(patch, chunk, k, &light);
        }
      }
    });
    return straight;
  }

  void AddFinePatches(std::uint32_t at, int chunk, int k, Straight* light) const {
    if (k == 1 && is_phantom_[at] == 0) return;
    const RayTargets targets = k == 0 ? RayTargets::kEverything : RayTargets::kPhantoms;
    const int last = std::min((chunk + 1) * kP, patches_.count());
    for (int patch = chunk * kP; patch < last; ++patch) {
      const std::uint32_t seed = Hash(Hash(at, kFineSalt), static_cast<std::uint32_t>(patch));
      const PatchScene::PatchSample& surface_sample = scene_.AnyPatchSample(at, Hash(seed, 1));
      const Vec3 direction =
          patches_.Within(patch, UnitFromHash(Hash(seed, 2)), UnitFromHash(Hash(seed, 3)));
      const double cosine = Dot(Normalized({surface_sample.normal[0], surface_sample.normal[1],
                                            surface_sample.normal[2]}),
                                direction);
      if (cosine <= 0.0 || scene_.rays->Occluded(targets, surface_sample.origin, direction))
        continue;
      (*light)[patch % kP] = static_cast<float>(cosine * patches_.SolidAngle(patch));
    }
  }

  std::vector<ChunkLight> SolveRadiosity(const std::vector<ChunkLight>& arriving, int k) const {
    constexpr float kInvPi = std::numbers::inv_pi_v<float>;
    std::vector<ChunkLight> reflected(arriving.size());
    ParallelFor(gathered_.blocks.size(), threads_, [&](std::size_t index) {
      std::vector<ReflectingPlace> places;
      ForEachPatch(
          gathered_, index,
          [&](std::uint32_t patch, const FinalGather::Hit* first, const FinalGather::Hit* last) {
            places.clear();
            const float factor = kInvPi * gathered_.RayWeight(patch, k);
            for (const FinalGather::Hit* hit = first; hit != last; ++hit) {
              if ((k == 0 ? hit->with : hit->without) == 0) continue;
              const PatchScene::Face& face = scene_.faces[hit->face];
              const auto corners = CornersOf(face, *hit);
              const float u = static_cast<float>(hit->u) / 65535.0F;
              const float v = static_cast<float>(hit->v) / 65535.0F;
              const auto send = [&](const std::array<std::uint32_t, 3>& from,
                                    const std::array<float, 3>& share) {
                places.push_back({{&arriving[from[0]], &arriving[from[1]], &arriving[from[2]]},
                                  {1.0F - u - v, u, v},
                                  {share[0] * factor, share[1] * factor, share[2] * factor}});
              };
              const PatchScene::MeshSide& side = scene_.mesh_sides[face.mesh_side];
              send(corners, side.albedo);
              if (scene_.Transmits(face)) send(OtherCornersOf(face, *hit), side.transmittance);
            }
            AddInterreflections(places, &reflected[patch]);
          });
    });
    return reflected;
  }

  const PatchScene& scene_;
  const FinalGather& gathered_;
  const SkyPatches& patches_;
  std::vector<std::uint8_t> is_phantom_;
  int threads_;
  std::array<std::vector<std::uint8_t>, 2> inside_;
};

}  // namespace

DaylightCoefficients ComputeCoefficients(const PatchScene& scene, Vec3 up,
                                         const CoefficientOptions& options,
                                         const CoefficientProgress& progress) {
  const auto report = [&](double share) {
    if (progress) progress(share);
  };
  report(0.0);
  DaylightCoefficients coefficients;
  coefficients.division = options.division;
  coefficients.up = up;
  const SkyPatches patches = coefficients.Patches();
  const std::uint32_t affordable = kRayBudget / std::max(1U, scene.patch_count);
  const int rays = static_cast<int>(std::min(static_cast<std::uint32_t>(options.rays_per_vertex),
                                             std::max(kMinRays, affordable)));
  const FinalGather gathered = GatherPatches(scene, patches, rays, options.threads, options.stop);
  if (options.stop != nullptr && *options.stop) return coefficients;
  report(kShareOfRays);
  Transfer transfer(scene, gathered, patches, options.threads);
  coefficients.with = CoefficientMatrix(scene.patch_count, patches.total());
  coefficients.without = CoefficientMatrix(scene.patch_count, patches.total());
  const int chunks = coefficients.with.chunks();
  for (int chunk = 0; chunk < chunks; ++chunk) {
    for (const int k : {0, 1}) {
      if (options.stop != nullptr && *options.stop) return coefficients;
      CoefficientMatrix* matrix = k == 0 ? &coefficients.with : &coefficients.without;
      coefficients.reflections = std::max(coefficients.reflections,
                                          transfer.Follow(chunk, k, options.convergence, matrix));
    }
    report(kShareOfRays + (1 - kShareOfRays) * (chunk + 1) / chunks);
  }
  return coefficients;
}

std::uint64_t GeometryHash(const PatchScene& scene, Vec3 up, const CoefficientOptions& options) {
  // Fowler, Noll & Vo, FNV-1a.
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  const auto add = [&](const void* bytes, std::size_t size) {
    const auto* at = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ at[i]) * 0x100000001B3ULL;
  };
  const auto add_all = [&](const auto& values) {
    const std::uint64_t count = values.size();
    add(&count, sizeof count);
    add(values.data(), values.size() * sizeof(values[0]));
  };
  add(&kMethodVersion, sizeof kMethodVersion);
  const double numbers[] = {up.x,
                            up.y,
                            up.z,
                            options.convergence,
                            static_cast<double>(options.division),
                            static_cast<double>(options.rays_per_vertex)};
  add(numbers, sizeof numbers);
  for (const PatchScene::MeshSide& mesh_side : scene.mesh_sides) {
    add_all(mesh_side.mesh.positions);
    add_all(mesh_side.mesh.normals);
    add_all(mesh_side.mesh.indices);
    add_all(mesh_side.albedo);
    // Scenes that transmit no light keep their hash.
    if (mesh_side.transmittance != std::array<float, 3>{}) add_all(mesh_side.transmittance);
    if (mesh_side.groups) add_all(mesh_side.groups->patch_of);
    const std::int32_t flags[] = {mesh_side.mesh.is_phantom, mesh_side.mesh.closed, mesh_side.twin,
                                  mesh_side.mesh.role == MeshRole::kRenderOnly};
    add(flags, sizeof flags);
  }
  return hash;
}

}  // namespace pleinair::compositor
