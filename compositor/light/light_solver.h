#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver_options.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/phantom_rays.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/models/placed_model.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

struct PatchScene;

/// Computes where the day's light goes among phantoms and virtual objects. Keeps the ray scene (in
/// Embree), so that phantoms() answers queries later.
class LightSolver {
 public:
  /// Tessellates and builds the ray scene. Errors: an empty or degenerate geometry.
  static Result<std::unique_ptr<LightSolver>> Create(const std::vector<PlacedModel>& scene,
                                                     const LightSolverOptions& options);
  ~LightSolver();

  /// Light on every vertex for this daylight. Deterministic whatever the number of threads. Rays
  /// with and without the virtual objects are the same, so that their ratio has no noise where
  /// the objects change nothing.
  std::vector<LitMesh> Solve(const sky::SkyModel& daylight, const Mat3& marker_from_world) const {
    return SolveUnderTrees(daylight, marker_from_world, {});
  }
  /// As Solve(); of the sun, surfaces reflect what `sun_transmittance` leaves it. A map without
  /// cells, as made by default, stands for no trees.
  std::vector<LitMesh> SolveUnderTrees(const sky::SkyModel& daylight, const Mat3& marker_from_world,
                                       const SunTransmittanceMap& sun_transmittance) const;

  /// The scene's daylight coefficients, with which Relight() gives the light of any day: from the
  /// cache where it has them, otherwise computed and put there. Several seconds; may run beside
  /// everything else. `up`: unit, marker coordinates.
  DaylightCoefficients Coefficients(Vec3 up, const CoefficientOptions& options,
                                    const CoefficientProgress& progress) const;

  /// As Solve(), by one product with the coefficients. The sun's reflected light comes from the
  /// patches around it, so that the shadows it draws on what reflects are some degrees soft.
  std::vector<LitMesh> Relight(const DaylightCoefficients& coefficients,
                               const sky::SkyModel& daylight, const Mat3& marker_from_world) const;

  /// Mean radiance that comes from below the horizon to where the virtual objects stand: of the
  /// phantoms in sun and shade, textures as their mean, and of the land where they end, seen from
  /// the middle of each object and averaged. For glossy reflections. `sun_transmittance` as above.
  /// cd/m², linear Rec.709; black without an object.
  LinearRgb RadianceFromBelow(const sky::SkyModel& daylight, const Mat3& marker_from_world,
                              const SunTransmittanceMap& sun_transmittance = {}) const;

  /// Ray queries against the scene's phantoms; valid while this lives.
  const PhantomRays& phantoms() const { return *phantoms_; }

 private:
  LightSolver(PatchScene scene, const LightSolverOptions& options);

  LightSolverOptions options_;
  std::unique_ptr<const PatchScene> scene_;
  std::unique_ptr<const PhantomRays> phantoms_;
  std::uint64_t first_geometry_ = 0;  // LitMesh::geometry of the first mesh side; others follow.
};

}  // namespace pleinair::compositor
