#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver_options.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/models/placed_model.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// Where a line of sight meets a real surface.
struct PhantomSurface {
  Point<Marker> point;
  Vec3 normal;         ///< Unit, towards the eye.
  int surface = 0;     ///< Equal for points of one side of one surface of one material.
  LinearRgb albedo{};  ///< That the phantom states, textures as their mean.
  /// Of a phantom's loose leaves (foliage.h): what is seen there is a leaf or what stands
  /// behind, and tells of no surface. Only `point` is set.
  bool is_foliage = false;
};

/// Computes where the day's light goes among phantoms and virtual objects (Embree). Keeps the ray
/// scene, so that the sun's visibility at any point can be asked later.
class LightSolver {
 public:
  /// Tessellates and builds the ray scene. Errors: an empty or degenerate geometry.
  static Result<std::unique_ptr<LightSolver>> Create(const std::vector<PlacedModel>& scene,
                                                     const LightSolverOptions& options);
  virtual ~LightSolver() = default;

  /// Light on every vertex for this daylight. Deterministic whatever the number of threads. Rays
  /// with and without the virtual objects are the same, so that their ratio has no noise where
  /// the objects change nothing.
  std::vector<LitMesh> Solve(const sky::SkyModel& daylight, const Mat3& marker_from_world) const {
    return SolveUnderTrees(daylight, marker_from_world, {});
  }
  /// As Solve(); of the sun, surfaces reflect what `sunlight` leaves it. A map without cells, as
  /// made by default, stands for no trees.
  virtual std::vector<LitMesh> SolveUnderTrees(
      const sky::SkyModel& daylight, const Mat3& marker_from_world,
      const SunTransmittanceMap& sun_transmittance) const = 0;

  /// The scene's daylight coefficients, with which Relight() gives the light of any day: from the
  /// cache where it has them, otherwise computed and put there. Several seconds; may run beside
  /// everything else. `up`: unit, marker coordinates.
  virtual DaylightCoefficients Coefficients(Vec3 up, const CoefficientOptions& options,
                                            const CoefficientProgress& progress) const = 0;

  /// As Solve(), by one product with the coefficients. The sun's reflected light comes from the
  /// patches around it, so that the shadows it draws on what reflects are some degrees soft.
  virtual std::vector<LitMesh> Relight(const DaylightCoefficients& coefficients,
                                       const sky::SkyModel& daylight,
                                       const Mat3& marker_from_world) const = 0;

  /// Share of the sun's disc (0…1) that the phantoms alone leave visible from a point.
  virtual double SunVisibilityPhantomsOnly(Point<Marker> point, Vec3 to_sun_in_marker) const = 0;

  /// Whether nothing of the phantoms lies between a point and one point of the sky.
  virtual bool IsUnoccludedPhantomsOnly(Point<Marker> point, Vec3 direction) const = 0;

  /// The phantom that a line of sight meets first; nothing where it meets none. `direction` unit.
  virtual std::optional<PhantomSurface> FirstPhantom(Point<Marker> eye, Vec3 direction) const = 0;

  /// Sky and bounced light on small surfaces at `points` that all face `normal`, phantoms only:
  /// what reaches the marker's marker. One value a point, in their order; `paths` are followed for
  /// each. Ask for many points at once: the sky is tabulated anew for every call.
  virtual std::vector<LinearRgb> AmbientPhantomsOnly(std::span<const Point<Marker>> points,
                                                     Vec3 normal, const sky::SkyModel& daylight,
                                                     const Mat3& marker_from_world,
                                                     std::uint32_t paths = kMarkerPaths) const = 0;

  /// Mean radiance that comes from below the horizon to where the virtual objects stand: of the
  /// phantoms in sun and shade, textures as their mean, and of the land where they end, seen from
  /// the middle of each object and averaged. For glossy reflections. `sunlight` as above. cd/m²,
  /// linear Rec.709; black without an object.
  virtual LinearRgb RadianceFromBelow(const sky::SkyModel& daylight, const Mat3& marker_from_world,
                                      const SunTransmittanceMap& sun_transmittance = {}) const = 0;

  static constexpr std::uint32_t kMarkerPaths = 2048;
};

}  // namespace pleinair::compositor
