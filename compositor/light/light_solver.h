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

/// Computes the direct and indirect daylight on phantoms and virtual objects. It keeps the ray
/// scene (in Embree) so that phantoms() can answer queries later.
class LightSolver {
 public:
  /// Tessellates and builds the ray scene. Errors: an empty or degenerate geometry.
  static Result<std::unique_ptr<LightSolver>> Create(const std::vector<PlacedModel>& scene,
                                                     const LightSolverOptions& options);
  ~LightSolver();

  /// The same scene and surfaces (LitMesh::geometry), solved with another number of rays per vertex
  /// (LightSolverOptions). Costs nothing.
  std::unique_ptr<LightSolver> WithRays(int rays_per_vertex) const;

  /// Computes the light on every vertex for this daylight. The result does not depend on the number
  /// of threads. The same rays serve the cases with and without the virtual objects. Their ratio
  /// therefore has no noise where the objects change nothing.
  std::vector<LitMesh> Solve(const sky::SkyModel& daylight, const Mat3& marker_from_world) const {
    return SolveUnderTrees(daylight, marker_from_world, {});
  }
  /// As Solve(), but surfaces reflect the sunlight that `sun_transmittance` transmits. A
  /// default-constructed map has no cells and means that there are no trees.
  std::vector<LitMesh> SolveUnderTrees(const sky::SkyModel& daylight, const Mat3& marker_from_world,
                                       const SunTransmittanceMap& sun_transmittance) const;

  /// Returns the scene's daylight coefficients, from which Relight() computes the light of any day.
  /// They come from the cache if it has them; otherwise they are computed and cached. The
  /// computation takes several seconds and may run in parallel with everything else. `up`: unit,
  /// marker coordinates.
  DaylightCoefficients Coefficients(Vec3 up, const CoefficientOptions& options,
                                    const CoefficientProgress& progress) const;

  /// As Solve(), by one product with the coefficients. The sun's reflected light comes from the sky
  /// patches around the sun. Shadows in reflected sunlight are therefore soft by some degrees.
  std::vector<LitMesh> Relight(const DaylightCoefficients& coefficients,
                               const sky::SkyModel& daylight, const Mat3& marker_from_world) const;

  /// Mean radiance from below the horizon at the virtual objects, for glossy reflections. It
  /// includes sunlit and shadowed phantoms, with textures as their mean, and the land beyond them.
  /// It is estimated at the middle of each object and averaged. `sun_transmittance` as above. Unit:
  /// cd/m², linear Rec.709; black without an object.
  LinearRgb RadianceFromBelow(const sky::SkyModel& daylight, const Mat3& marker_from_world,
                              const SunTransmittanceMap& sun_transmittance = {}) const;

  /// Ray queries against the scene's phantoms; valid as long as this object.
  const PhantomRays& phantoms() const { return *phantoms_; }

 private:
  LightSolver(PatchScene scene, const LightSolverOptions& options);
  LightSolver(const LightSolver&) = default;

  LightSolverOptions options_;
  std::shared_ptr<const PatchScene> scene_;
  std::shared_ptr<const PhantomRays> phantoms_;
  std::uint64_t first_geometry_ = 0;  // LitMesh::geometry of the first mesh side; others follow.
};

}  // namespace pleinair::compositor
