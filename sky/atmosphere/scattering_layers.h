#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <vector>

#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/scattered_light.h"

namespace pleinair::sky::internal {

/// Directions per hemisphere: zenith cosines of Gauss–Legendre quadrature on (0, 1).
inline constexpr int kGauss = 8;
struct GaussNodes {
  std::array<double, kGauss> mu, weight;
};
const GaussNodes& Gauss();

/// Fourier coefficients of a phase function between two zenith cosines:
/// p = P_0 + 2 Σ P_m cos(m φ).
using MoleculeFourier = std::array<double, ScatteredLight::kMoleculeModes>;
using AerosolFourier = std::array<double, ScatteredLight::kAerosolModes>;
MoleculeFourier FourierOfMolecules(double mu, double mu_other);
AerosolFourier FourierOfAerosol(double asymmetry, double mu, double mu_other);

/// Radiances or sources at one level, Fourier modes × Gaussian directions. `above`: from directions
/// above the horizon (µ > 0); `below`: from those below it.
struct LevelField {
  std::array<std::array<Spectrum, kGauss>, ScatteredLight::kAerosolModes> above, below;
};
using Field = std::vector<LevelField>;  ///< One per level.

/// Phase functions between the Gaussian directions, with quadrature weights applied.
class PhaseMatrices {
 public:
  explicit PhaseMatrices(double asymmetry);

  /// Source function of a level from the radiances there. `molecules` and `aerosol` are the
  /// scattering coefficients of each as shares of the extinction at that level.
  void Scatter(const LevelField& radiance, const Spectrum& molecules, const Spectrum& aerosol,
               LevelField* source) const;

 private:
  // Half the sum and half the difference of the coefficients to the same and to the opposite
  // hemisphere, times 2π and the Gaussian weight: [mode][out][in].
  template <int kModes>
  using Matrix = std::array<std::array<std::array<float, kGauss>, kGauss>, kModes>;
  Matrix<ScatteredLight::kMoleculeModes> molecules_even_{}, molecules_odd_{};
  Matrix<ScatteredLight::kAerosolModes> aerosol_even_{}, aerosol_odd_{};
};

/// Plane layers between the levels, and the transfer of light through them.
class Layers {
 public:
  explicit Layers(const AirMedium& medium);

  static double Height(int level);
  const Spectrum& MoleculeShare(int level) const { return molecule_share_[level]; }
  const Spectrum& AerosolShare(int level) const { return aerosol_share_[level]; }

  /// Radiances that result from a source function. On level 0, `below` is the light reflected by
  /// the ground: `ground_direct` (sunlight) plus the ground's albedo times the diffuse light.
  void Transport(const Field& source, const Spectrum& ground_direct, Field* radiance) const;

 private:
  struct Step {
    Spectrum through, near, far;
  };
  double ground_albedo_;
  std::array<Spectrum, ScatteredLight::kLevels> molecule_share_, aerosol_share_;
  std::vector<std::array<Step, kGauss>> steps_;  ///< One per layer.
};

}  // namespace pleinair::sky::internal
