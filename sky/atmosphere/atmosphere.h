#pragma once

#include <memory>
#include <vector>

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"
#include "sky/atmosphere/aerial_perspective.h"
#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/optical_depth.h"
#include "sky/atmosphere/scattered_light.h"
#include "sky/color.h"

namespace pleinair::sky {

/// Tables of one atmosphere that do not depend on the sun's position; computed once.
struct AtmosphereTables {
  AirMedium medium;
  OpticalDepthTable depths;
  ScatteredLight scattered;

  explicit AtmosphereTables(const Aerosol& aerosol, double ground_albedo)
      : medium(aerosol, ground_albedo), depths(medium), scattered(medium, depths) {}
};

/// CIE XYZ of the sun on a surface facing it, lux, after atmospheric extinction. Mean over the
/// disc; the part below a level horizon does not count. `to_sun`: apparent, unit vector, east,
/// north, up.
Vec3 SunXyz(const AtmosphereTables& tables, Direction<World> to_sun, double sun_distance_au);

/// Physically based sky over an observer on the ground, for one sun position: a sky-view table
/// after Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique",
/// §5.3.
///
/// Deviations: eight wavelengths in place of three. Multiple scattering keeps its directions
/// (sky/atmosphere/scattered_light.h). The aerosol's single scattering is stored apart, so that its
/// peak around the sun is computed and not interpolated. Light is integrated along the curved
/// shells exactly.
class AtmosphereSky {
 public:
  static constexpr int kRings = 64;    ///< Elevations, 90° t².
  static constexpr int kSectors = 40;  ///< Azimuths from the sun's, 180° t^1.5.

  /// A node of the sky-view table: CIE XYZ in cd/m². The sky is `scattered` + `aerosol` times the
  /// aerosol's phase function (1/sr).
  struct Node {
    std::array<float, 3> scattered{};
    std::array<float, 3> aerosol{};
  };

  /// `to_sun`: apparent, unit vector, east, north, up. The light is that at `sun_distance_au`.
  AtmosphereSky(std::shared_ptr<const AtmosphereTables> tables, Direction<World> to_sun,
                double sun_distance_au);

  /// CIE XYZ, cd/m²; zero below the horizon.
  Vec3 Xyz(Direction<World> from) const;

  /// Elevation (radians) at which the sky of `elevation` is evaluated. Elevations e below a bound b
  /// become b e^(e/b − 1), which is continuous and smooth at b.
  ///
  /// Why: in clean air or with a low sun, the lowest degrees of the sky brighten upwards by up to
  /// 12 % in 0.1° (a path tracer agrees), in proportion to 1/e. The softened gradient is 12 % / b
  /// at most. No real horizon shows more, because of its 0.6° of refraction and its hills. b is
  /// 2.9° by day and larger in twilight, when the earth's shadow steepens the gradient. At level
  /// sight, e = 0, the sky of 1.1° is used.
  static double SoftenedElevation(double elevation, double sun_elevation);

  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  void FillRing(int ring);

  std::shared_ptr<const AtmosphereTables> tables_;
  Direction<World> to_sun_;
  double closeness_ = 1.0;  ///< 1 / distance².
  std::vector<Node> nodes_;
};

}  // namespace pleinair::sky
