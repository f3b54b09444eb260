#pragma once

#include <array>
#include <vector>

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"

namespace pleinair::sky {

struct AtmosphereTables;

/// Aerial perspective: radiance = radiance · transmittance + inscattered, in linear Rec.709, cd/m².
///
/// Valid near the ground and for distances of a scene. Three simplifications: the incident light
/// along the ray is that at the eye; the density of the air falls exponentially with height; each
/// gas has one extinction coefficient per color channel. Inscattered light is within 12 % of a path
/// tracer's at 2 and 20 km (tests/sky/atmosphere/aerial_perspective_test.cc).
class AerialPerspective {
 public:
  AerialPerspective(const AtmosphereTables& tables, Direction<World> to_sun,
                    double sun_distance_au);

  /// `towards`: unit vector, east, north, up. The eye is 2 m above the ground.
  LinearRgb Transmittance(Direction<World> towards, Metres distance) const;
  LinearRgb Inscattered(Direction<World> towards, Metres distance) const;

 private:
  static constexpr int kRows = 37;     ///< Elevations, −90°…90° in steps of 5°.
  static constexpr int kSectors = 13;  ///< Azimuths from the sun's, 180° t^1.5.

  /// Light that one metre of air at the eye's height inscatters, linear Rec.709, cd/m² per metre.
  struct Node {
    std::array<float, 3> molecules{};
    std::array<float, 3> aerosol{};  ///< Without direct sunlight.
  };

  /// Values common to all nodes; lengths in metres.
  struct Constants {
    std::array<float, 3> sun_on_aerosol{};  ///< To be multiplied by the aerosol's phase function.
    std::array<float, 3> molecule_extinction{}, aerosol_extinction{};  ///< At the ground.
    float aerosol_scale_height = 0.0F, asymmetry = 0.0F;
    std::array<float, 3> to_sun{};
  };

  struct Columns {
    double molecules, aerosol;
  };
  Columns ColumnsTo(Direction<World> towards, Metres distance) const;
  std::array<double, 3> OpticalDepth(const Columns& columns) const;

  Constants constants_;
  std::vector<Node> nodes_;
};

}  // namespace pleinair::sky
