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

/// Where a line of sight hits a real surface.
struct PhantomSurface {
  Point<Marker> point;
  Vec3 normal;         ///< Unit, towards the camera.
  int surface = 0;     ///< Equal for points on one side of one surface of one material.
  LinearRgb albedo{};  ///< The phantom's albedo, textures as their mean.
  /// The hit belongs to a phantom's foliage (foliage.h). The image shows a leaf or its background
  /// there, so it measures no surface. Only `point` is set.
  bool is_foliage = false;
  int placed_model = 0;  ///< Index into the scene's list of placed models.
};

/// A place on a surface, and the way it faces: unit.
struct FacingPoint {
  Point<Marker> point;
  Vec3 normal;
};

/// Ray queries against the phantoms of a scene. Virtual objects neither hide nor shade anything
/// here, because the camera sees the place without them. Thread-safe.
class PhantomRays {
 public:
  virtual ~PhantomRays() = default;

  /// Fraction of the sun's disc (0…1) that is visible from a point.
  virtual double SunVisibility(Point<Marker> point, Vec3 to_sun_in_marker) const = 0;

  /// Returns whether nothing occludes one point of the sky.
  virtual bool IsUnoccluded(Point<Marker> point, Vec3 direction) const = 0;

  /// The phantom that a line of sight hits first, or nothing. `direction` is a unit vector.
  virtual std::optional<PhantomSurface> First(Point<Marker> eye, Vec3 direction) const = 0;

  /// Sky light and reflected light on small surfaces at `points`: lux, linear Rec.709. The result
  /// has one value per point, in order; each traces `paths` paths. Query many points at once,
  /// because every call tabulates the sky anew.
  virtual std::vector<LinearRgb> Ambient(std::span<const FacingPoint> points,
                                         const sky::SkyModel& daylight,
                                         const Mat3& marker_from_world,
                                         std::uint32_t paths = kMarkerPaths) const = 0;
  /// The same where all face `normal`.
  std::vector<LinearRgb> Ambient(std::span<const Point<Marker>> points, Vec3 normal,
                                 const sky::SkyModel& daylight, const Mat3& marker_from_world,
                                 std::uint32_t paths = kMarkerPaths) const {
    std::vector<FacingPoint> facing;
    facing.reserve(points.size());
    for (const Point<Marker>& point : points) facing.push_back({point, normal});
    return Ambient(facing, daylight, marker_from_world, paths);
  }

  static constexpr std::uint32_t kMarkerPaths = 2048;
};

/// Makes queries with Embree. `scene` must outlive the result.
std::unique_ptr<const PhantomRays> MakePhantomRays(const PatchScene& scene,
                                                   const LightSolverOptions& options);

}  // namespace pleinair::compositor
