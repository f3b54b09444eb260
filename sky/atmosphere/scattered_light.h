#pragma once

#include <array>
#include <vector>

#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/optical_depth.h"

namespace pleinair::sky {

/// Light that has been scattered or reflected at least once, as the air scatters it again: for
/// every height, place of the sun and direction of view.
///
/// Deviation from Hillaire 2020, §5.5, who takes all orders from the second on as isotropic: here
/// they keep their directions. Successive orders of scattering are followed through plane layers
/// (Liou 2002, "An Introduction to Atmospheric Radiation", §3.2), in Gaussian directions and a
/// Fourier series of the azimuth, with the sun weakened as in the round atmosphere. Why, and what
/// it wins: docs/method/sky.md. It depends on the air alone: made once, good for every place of the
/// sun.
class ScatteredLight {
 public:
  static constexpr int kMoleculeModes = 3;  ///< All that the molecules' phase function has.
  static constexpr int kAerosolModes = 7;
  static constexpr int kLevels = 34;
  static constexpr int kViews = 37;  ///< Elevations of view, −90°…90° in steps of 5°.
  static constexpr int kSuns = 40;

  ScatteredLight(const AirMedium& medium, const OpticalDepthTable& depths);

  /// Fourier coefficients (cosines of the azimuth from the sun's) of the light that one
  /// particle's worth of scattering sends towards the eye: J(φ) = Σ_m cos(m φ) (σ_molecules
  /// molecules[m] + σ_aerosol aerosol[m]); as shares of the sun's irradiance, per steradian.
  struct Source {
    std::array<Spectrum, kMoleculeModes> molecules;
    std::array<Spectrum, kAerosolModes> aerosol;
    void AddScaled(const Source& o, float s);
  };

  /// Elevations of the sun that are kept, ascending, degrees.
  static double SunElevationDeg(int sun);

  /// Where an elevation of the sun lies among them: index of the lower neighbour, share of the
  /// upper one.
  struct Place {
    int lower = 0;
    float upper_share = 0.0F;
  };
  static Place PlaceOfSun(double elevation_deg);

  /// At a height and for an elevation of view (−90…90°), interpolated; one of the kept suns.
  Source At(int sun, double height_m, double view_elevation_deg) const;

 private:
  const Source& Node(int sun, int level, int view) const {
    return table_[(static_cast<std::size_t>(sun) * kLevels + level) * kViews + view];
  }
  std::vector<Source> table_;
};

}  // namespace pleinair::sky
