#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <vector>

#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/scattered_light.h"

namespace pleinair::sky::internal {

/// Directions a hemisphere, zenith cosines by Gauss and Legendre on (0, 1).
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

/// A field of radiances or sources at one level: Fourier modes × Gaussian directions; `above` from
/// directions over the horizon (µ > 0), `below` from under it.
struct LevelField {
  std::array<std::array<Spectrum, kGauss>, ScatteredLight::kAerosolModes> above, below;
};
using Field = std::vector<LevelField>;  ///< One a level.

/// Phase functions between the Gaussian directions, ready to be applied.
class PhaseMatrices {
 public:
  explicit PhaseMatrices(double asymmetry);

  /// Source function of a level from the radiances there; `molecules` and `aerosol` are the
  /// shares of the extinction there that each scatters.
  void Scatter(const LevelField& radiance, const Spectrum& molecules, const Spectrum& aerosol,
               LevelField* source) const;

 private:
  // Sum and difference of the coefficients towards the same and the other hemisphere, halved,
  // times 2π and the Gaussian weight: [mode][out][in].
  template <int kModes>
  using Matrix = std::array<std::array<std::array<float, kGauss>, kGauss>, kModes>;
  Matrix<ScatteredLight::kMoleculeModes> molecules_even_{}, molecules_odd_{};
  Matrix<ScatteredLight::kAerosolModes> aerosol_even_{}, aerosol_odd_{};
};

/// Plane layers between the levels, and how light passes through them.
class Layers {
 public:
  explicit Layers(const AirMedium& medium);

  static double Height(int level);
  const Spectrum& MoleculeShare(int level) const { return molecule_share_[level]; }
  const Spectrum& AerosolShare(int level) const { return aerosol_share_[level]; }

  /// Radiances that a source function gives rise to; on level 0 `below` is what the ground sends
  /// up: `ground_direct` (of the sun) and, of what comes down, the ground's albedo.
  void Transport(const Field& source, const Spectrum& ground_direct, Field* radiance) const;

 private:
  struct Step {
    Spectrum through, near, far;
  };
  double ground_albedo_;
  std::array<Spectrum, ScatteredLight::kLevels> molecule_share_, aerosol_share_;
  std::vector<std::array<Step, kGauss>> steps_;  ///< One a layer.
};

}  // namespace pleinair::sky::internal
