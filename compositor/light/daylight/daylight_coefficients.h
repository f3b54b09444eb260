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
  int division = 1;           ///< Subdivision of Tregenza's patches, 1…4.
  int rays_per_vertex = 256;  ///< Or per patch of a fine surface; fewer in huge scenes.
  /// The paper's convergence rate: the iteration stops when a reflection adds less than this
  /// fraction of all the light.
  double convergence = 0.01;
  int threads = 0;                   ///< 0: one per processor.
  std::filesystem::path cache = {};  ///< Folder; empty: no cache.
  /// The computation ends soon after this is set. Its result is then incomplete and not cached.
  const std::atomic<bool>* stop = nullptr;
};

/// Reports the progress, 0…1. It may be called from any thread, one at a time.
using CoefficientProgress = std::function<void(double)>;

/// Daylight coefficients (Tregenza & Waters 1983, "Daylight coefficients", Lighting Research &
/// Technology 15(2)): the light that each sky patch sends to every vertex of a scene. It arrives
/// directly and after reflections among virtual objects and phantoms. Surfaces finer than the light
/// needs have patches instead of vertices. The coefficients are computed once for a geometry. The
/// light of any date, time and sky is then one matrix product.
///
/// The rays of every vertex are traced once. A vertex exchanges light only with the surfaces that
/// they hit (the paper's caster culling). The light of all patches follows these links until a
/// further reflection adds less than the convergence rate.
///
/// Deviation from the paper: instead of shooting from the largest unshot patch, all vertices gather
/// at once. A vertex' rays are available, and the result does not depend on an order.
struct DaylightCoefficients {
  int division = 1;
  Vec3 up;                    ///< Marker coordinates.
  CoefficientMatrix with;     ///< With the virtual objects present.
  CoefficientMatrix without;  ///< With the phantoms alone; rows of virtual objects are 0.
  int reflections = 0;        ///< Computed until convergence.
  bool from_cache = false;
  bool kept = true;  ///< False: the result could not be written to the requested cache.

  SkyPatches Patches() const { return {up, division}; }
};

DaylightCoefficients ComputeCoefficients(const PatchScene& scene, Vec3 up,
                                         const CoefficientOptions& options,
                                         const CoefficientProgress& progress);

/// Hash of all inputs of the coefficients and of the method's version: FNV-1a, 64 bits.
std::uint64_t GeometryHash(const PatchScene& scene, Vec3 up, const CoefficientOptions& options);

/// Writes the file "HASH.dlc" for ReadCoefficients(), and creates the folder. Returns whether the
/// file exists. A write failure is no error, because the next run computes again.
bool WriteCoefficients(const std::filesystem::path& folder, std::uint64_t hash,
                       const DaylightCoefficients& coefficients);

/// Returns nothing if no file has this hash or the file is damaged.
std::optional<DaylightCoefficients> ReadCoefficients(const std::filesystem::path& folder,
                                                     std::uint64_t hash);

}  // namespace pleinair::compositor
