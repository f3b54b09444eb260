#pragma once

#include <array>
#include <vector>

#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"

namespace pleinair::sky {

struct AtmosphereTables;

/// What the air between the eye and a thing does to its light: radiance = radiance · transmittance
/// + inscattered, linear Rec.709, cd/m².
///
/// For distances of a scene, near the ground: the light that arrives from all sides is taken as
/// that at the eye, the air's density as falling with height along the way, and each color
/// channel as having one coefficient of extinction a gas. Against a path tracer the inscattered
/// light is within 12 % at 2 and 20 km (tests/sky/atmosphere/aerial_perspective_test.cc).
class AerialPerspective {
 public:
  AerialPerspective(const AtmosphereTables& tables, Direction<World> to_sun,
                    double sun_distance_au);

  /// `towards`: unit vector, east, north, up; from an eye 2 m above the ground.
  LinearRgb Transmittance(Direction<World> towards, Metres distance) const;
  LinearRgb Inscattered(Direction<World> towards, Metres distance) const;

 private:
  static constexpr int kRows = 37;     ///< Elevations, −90°…90° in steps of 5°.
  static constexpr int kSectors = 13;  ///< Azimuths from the sun's, 180° t^1.5.

  /// Light that a metre of air at the eye's height adds, linear Rec.709, cd/m² a metre.
  struct Node {
    std::array<float, 3> molecules{};
    std::array<float, 3> aerosol{};  ///< Without the sun's own light.
  };

  /// What holds for every node; lengths in metres.
  struct Constants {
    std::array<float, 3> sun_on_aerosol{};  ///< Times the aerosol's phase function.
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
