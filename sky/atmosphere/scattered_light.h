#pragma once

#include <array>
#include <vector>

#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/optical_depth.h"

namespace pleinair::sky {

/// Source function of multiple scattering: light that has been scattered or reflected at least once
/// and is scattered again, for every height, sun position and view direction.
///
/// Deviation from Hillaire 2020, §5.5, where all orders from the second on are isotropic: here they
/// keep their directions. Successive orders of scattering are computed in plane layers (Liou 2002,
/// "An Introduction to Atmospheric Radiation", §3.2), in Gaussian directions and a Fourier series
/// of the azimuth; the sun's transmittance is that of the spherical atmosphere. docs/method/sky.md
/// has the reason and the gain. Depends on the atmosphere alone: computed once for all sun
/// positions.
class ScatteredLight {
 public:
  static constexpr int kMoleculeModes = 3;  ///< The phase function of molecules has no more.
  static constexpr int kAerosolModes = 7;
  static constexpr int kLevels = 34;
  static constexpr int kViews = 37;  ///< Elevations of view, −90°…90° in steps of 5°.
  static constexpr int kSuns = 40;

  ScatteredLight(const AirMedium& medium, const OpticalDepthTable& depths);

  /// Fourier coefficients (cosines of the azimuth from the sun's) of the light that one unit of
  /// scattering sends towards the eye: J(φ) = Σ_m cos(m φ) (σ_molecules molecules[m] + σ_aerosol
  /// aerosol[m]); relative to the sun's irradiance, per steradian.
  struct Source {
    std::array<Spectrum, kMoleculeModes> molecules;
    std::array<Spectrum, kAerosolModes> aerosol;
    void AddScaled(const Source& o, float s);
  };

  /// Sun elevations of the table, ascending, degrees.
  static double SunElevationDeg(int sun);

  /// Position of an elevation in that table: index of the lower neighbour, weight of the upper one.
  struct Place {
    int lower = 0;
    float upper_share = 0.0F;
  };
  static Place PlaceOfSun(double elevation_deg);

  /// Interpolated at a height and a view elevation (−90…90°), for the sun elevation of index `sun`.
  Source At(int sun, double height_m, double view_elevation_deg) const;

 private:
  const Source& Node(int sun, int level, int view) const {
    return table_[(static_cast<std::size_t>(sun) * kLevels + level) * kViews + view];
  }
  std::vector<Source> table_;
};

}  // namespace pleinair::sky
