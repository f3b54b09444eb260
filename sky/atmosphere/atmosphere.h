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

/// What is made once for an air: the tables that do not depend on where the sun stands.
struct AtmosphereTables {
  AirMedium medium;
  OpticalDepthTable depths;
  ScatteredLight scattered;

  explicit AtmosphereTables(const Aerosol& aerosol, double ground_albedo)
      : medium(aerosol, ground_albedo), depths(medium), scattered(medium, depths) {}
};

/// CIE XYZ of the sun on a surface facing it, lux: what the air lets through, mean of its disc, as
/// much of it as stands above a level horizon. `to_sun` apparent, unit, east, north, up.
Vec3 SunXyz(const AtmosphereTables& tables, Direction<World> to_sun, double sun_distance_au);

/// The sky over an eye at the ground for one place of the sun, physically based: a sky-view table
/// after Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique",
/// §5.3. Deviations: eight wavelengths in place of three; scattered light with its directions
/// (sky/atmosphere/scattered_light.h); the aerosol's first scattering is kept apart, so that its
/// peak around the sun is computed and not interpolated; light is summed along the curved shells
/// exactly.
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

  /// `to_sun`: apparent, unit, east, north, up; its light as at `sun_distance_au`.
  AtmosphereSky(std::shared_ptr<const AtmosphereTables> tables, Direction<World> to_sun,
                double sun_distance_au);

  /// CIE XYZ, cd/m²; zero below the horizon.
  Vec3 Xyz(Direction<World> from) const;

  /// The elevation that the sky of `elevation` is computed for, radians. Elevations e below b are
  /// taken as b e^(e/b − 1), which meets e at b with its slope: in clean air and with the sun near
  /// the horizon the lowest degrees of the sky brighten upwards by up to 12 % in 0.1° (a path
  /// tracer agrees), about as 12 % / e; so softened, by 12 % / b at most. No real horizon, with its
  /// 0.6° of refraction and its hills, shows more. b is 2.9° by day (level sights look up by 1.1°,
  /// from 2.9° on nothing changes), and more in twilight, when the earth's shadow steepens it.
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
