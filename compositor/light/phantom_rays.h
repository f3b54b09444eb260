#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

struct LightSolverOptions;
struct PatchScene;

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

/// Ray queries against the phantoms of a scene. Virtual objects neither hide nor shade anything
/// here: the camera sees the place without them. Thread-safe.
class PhantomRays {
 public:
  virtual ~PhantomRays() = default;

  /// Share of the sun's disc (0…1) that is visible from a point.
  virtual double SunVisibility(Point<Marker> point, Vec3 to_sun_in_marker) const = 0;

  /// Whether nothing lies between a point and one point of the sky.
  virtual bool IsUnoccluded(Point<Marker> point, Vec3 direction) const = 0;

  /// The phantom that a line of sight meets first; nothing where it meets none. `direction` unit.
  virtual std::optional<PhantomSurface> First(Point<Marker> eye, Vec3 direction) const = 0;

  /// Sky light and reflected light on small surfaces at `points` that all face `normal`, lux,
  /// linear Rec.709. One value a point, in their order; `paths` are traced for each. Query many
  /// points at once: every call tabulates the sky anew.
  virtual std::vector<LinearRgb> Ambient(std::span<const Point<Marker>> points, Vec3 normal,
                                         const sky::SkyModel& daylight,
                                         const Mat3& marker_from_world,
                                         std::uint32_t paths = kMarkerPaths) const = 0;

  static constexpr std::uint32_t kMarkerPaths = 2048;
};

/// Queries by Embree. `scene` must live as long.
std::unique_ptr<const PhantomRays> MakePhantomRays(const PatchScene& scene,
                                                   const LightSolverOptions& options);

}  // namespace pleinair::compositor
