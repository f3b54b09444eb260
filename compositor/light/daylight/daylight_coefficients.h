#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/vector.h"
#include "compositor/light/daylight/coefficient_matrix.h"
#include "compositor/light/sky_patches.h"

namespace pleinair::compositor {

struct PatchScene;

struct CoefficientOptions {
  int division = 1;           ///< Of Tregenza's patches, 1…4.
  int rays_per_vertex = 256;  ///< Or patch of a fine surface; lowered for huge scenes.
  /// Reflections are followed until the last adds less than this share of all the light. The
  /// paper's convergence rate.
  double convergence = 0.01;
  int threads = 0;                   ///< 0: as many as there are processors.
  std::filesystem::path cache = {};  ///< Folder; empty: nothing is kept.
  /// Once it is set, the computation ends soon; what it gives then is incomplete and not kept.
  const std::atomic<bool>* stop = nullptr;
};

/// How far the computation is, 0…1. May be called from any thread, one at a time.
using CoefficientProgress = std::function<void(double)>;

/// Daylight coefficients (Tregenza & Waters 1983, "Daylight coefficients", Lighting Research &
/// Technology 15(2)): what light each patch of the sky sends to every vertex of a scene (or patch
/// of its surfaces, where these are finer than light needs), straight and after reflections among
/// virtual objects and phantoms. Made once for a geometry; the light of any date, time and sky is
/// then one product with a matrix.
///
/// The rays of every vertex are traced once; the surfaces that they meet are the only ones it
/// exchanges light with (the paper's caster culling), and the light of all patches is passed along
/// them until what a further reflection adds is below the convergence rate. Deviation from
/// shooting, the largest unshot patch first: all gather at once, because a vertex' rays are at hand
/// and the result does not depend on an order.
struct DaylightCoefficients {
  int division = 1;
  Vec3 up;                    ///< Marker coordinates.
  CoefficientMatrix with;     ///< With the virtual objects there.
  CoefficientMatrix without;  ///< The phantoms alone; rows of virtual objects are 0.
  int reflections = 0;        ///< Followed until they had converged.
  bool from_cache = false;
  bool kept = true;  ///< False: the cache that they were to be put into could not take them.

  SkyPatches Patches() const { return {up, division}; }
};

DaylightCoefficients ComputeCoefficients(const PatchScene& scene, Vec3 up,
                                         const CoefficientOptions& options,
                                         const CoefficientProgress& progress);

/// A number that any change of what the coefficients depend on changes, the version of the method
/// among them: FNV-1a, 64 bits.
std::uint64_t GeometryHash(const PatchScene& scene, Vec3 up, const CoefficientOptions& options);

/// Writes what ReadCoefficients() reads, "HASH.dlc" in a folder, which is made. A file that cannot
/// be written is no error: the next run computes again. Returns whether it is there.
bool WriteCoefficients(const std::filesystem::path& folder, std::uint64_t hash,
                       const DaylightCoefficients& coefficients);

/// Nothing where there is none of that hash or the file is damaged.
std::optional<DaylightCoefficients> ReadCoefficients(const std::filesystem::path& folder,
                                                     std::uint64_t hash);

}  // namespace pleinair::compositor
