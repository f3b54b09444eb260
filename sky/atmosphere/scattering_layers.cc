#include "sky/atmosphere/scattering_layers.h"
#include "sky/gauss_rule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::sky::internal {
namespace {

using std::numbers::pi;
constexpr int kLevels = ScatteredLight::kLevels;
constexpr int kMoleculeModes = ScatteredLight::kMoleculeModes;
constexpr int kAerosolModes = ScatteredLight::kAerosolModes;

// Metres; denser where the aerosol is and where the light changes fast.
constexpr std::array<double, kLevels> kHeights = {
    0,      40,     90,     150,    225,    310,    410,    520,    650,    800,    980,   1'180,
    1'400,  1'650,  1'950,  2'300,  2'700,  3'150,  3'700,  4'300,  5'000,  6'000,  7'200, 8'600,
    10'200, 12'200, 14'600, 17'500, 21'000, 26'000, 33'000, 44'000, 62'000, 100'000};

double Sine(double mu) { return std::sqrt(std::max(0.0, 1.0 - mu * mu)); }

GaussNodes ComputeGauss() {
  const GaussRule rule = GaussOnUnitInterval(kGauss);
  GaussNodes nodes{};
  std::copy(rule.nodes.begin(), rule.nodes.end(), nodes.mu.begin());
  std::copy(rule.weights.begin(), rule.weights.end(), nodes.weight.begin());
  return nodes;
}

/// Mean density in a layer, relative to that at the ground.
double MeanExponential(double low, double high, double scale) {
  return scale * (std::exp(-low / scale) - std::exp(-high / scale)) / (high - low);
}

double MeanOzone(double low, double high) {
  constexpr int kSteps = 8;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += OzoneDensity(std::lerp(low, high, (i + 0.5) / kSteps));
  return sum / kSteps;
}

/// out[m][i] = Σ_j matrix[m][i][j] in[m][j].
template <typename Matrix, typename Modes>
void Multiply(const Matrix& matrix, const Modes& in, Modes* out) {
  for (std::size_t m = 0; m < matrix.size(); ++m) {
    for (int i = 0; i < kGauss; ++i) {
      Spectrum sum{};
      for (int j = 0; j < kGauss; ++j) sum.AddScaled(in[m][j], matrix[m][i][j]);
      (*out)[m][i] = sum;
    }
  }
}

}  // namespace

const GaussNodes& Gauss() {
  static const GaussNodes kNodes = ComputeGauss();
  return kNodes;
}

MoleculeFourier FourierOfMolecules(double mu, double mu_other) {
  // 3/(16π) (1 + cos² Θ), cos Θ = µ µ' + √(1−µ²) √(1−µ'²) cos φ, multiplied out.
  const double k = 3.0 / (16.0 * pi);
  const double c = mu * mu_other, s = Sine(mu) * Sine(mu_other);
  return {k * (1.0 + c * c + 0.5 * s * s), k * c * s, k * 0.25 * s * s};
}

AerosolFourier FourierOfAerosol(double asymmetry, double mu, double mu_other) {
  constexpr int kSamples = 48;
  static const auto kCosines = [] {
    std::array<std::array<double, kAerosolModes>, kSamples> cosines{};
    for (int i = 0; i < kSamples; ++i) {
      for (int m = 0; m < kAerosolModes; ++m)
        cosines[i][m] = std::cos(m * pi * (i + 0.5) / kSamples);
    }
    return cosines;
  }();
  const double c = mu * mu_other, s = Sine(mu) * Sine(mu_other);
  AerosolFourier sum{};
  for (int i = 0; i < kSamples; ++i) {
    const double phase = AerosolPhase(asymmetry, c + s * kCosines[i][1]) / kSamples;
    for (int m = 0; m < kAerosolModes; ++m) sum[m] += phase * kCosines[i][m];
  }
  return sum;
}

PhaseMatrices::PhaseMatrices(double asymmetry) {
  const GaussNodes& nodes = Gauss();
  // Energy conservation: each direction must scatter all the light that it received. The diagonal
  // takes what the quadrature misses of the forward peak.
  std::array<double, kGauss> total{};
  std::vector<AerosolFourier> same(kGauss * kGauss), other(kGauss * kGauss);
  for (int i = 0; i < kGauss; ++i) {
    for (int j = 0; j < kGauss; ++j) {
      same[i * kGauss + j] = FourierOfAerosol(asymmetry, nodes.mu[i], nodes.mu[j]);
      other[i * kGauss + j] = FourierOfAerosol(asymmetry, nodes.mu[i], -nodes.mu[j]);
      total[i] += 2.0 * pi * nodes.weight[j] * (same[i * kGauss + j][0] + other[i * kGauss + j][0]);
    }
  }
  for (int i = 0; i < kGauss; ++i) {
    const double missing = (1.0 - total[i]) / (2.0 * pi * nodes.weight[i]);
    for (double& coefficient : same[i * kGauss + i]) coefficient += missing;
    for (int j = 0; j < kGauss; ++j) {
      const double weight = pi * nodes.weight[j];  // Half of 2π.
      for (int m = 0; m < kAerosolModes; ++m) {
        const double s = same[i * kGauss + j][m], o = other[i * kGauss + j][m];
        // Reflection in the horizontal plane gives the opposite hemisphere's coefficients.
        aerosol_even_[m][i][j] = static_cast<float>(weight * (s + o));
        aerosol_odd_[m][i][j] = static_cast<float>(weight * (s - o));
      }
      const MoleculeFourier s = FourierOfMolecules(nodes.mu[i], nodes.mu[j]);
      const MoleculeFourier o = FourierOfMolecules(nodes.mu[i], -nodes.mu[j]);
      for (int m = 0; m < kMoleculeModes; ++m) {
        molecules_even_[m][i][j] = static_cast<float>(weight * (s[m] + o[m]));
        molecules_odd_[m][i][j] = static_cast<float>(weight * (s[m] - o[m]));
      }
    }
  }
}

void PhaseMatrices::Scatter(const LevelField& radiance, const Spectrum& molecules,
                            const Spectrum& aerosol, LevelField* source) const {
  using Modes = std::array<std::array<Spectrum, kGauss>, kAerosolModes>;
  Modes sum, difference, even, odd;
  for (int m = 0; m < kAerosolModes; ++m) {
    for (int i = 0; i < kGauss; ++i) {
      sum[m][i] = radiance.above[m][i] + radiance.below[m][i];
      difference[m][i] = radiance.above[m][i] - radiance.below[m][i];
    }
  }
  Multiply(aerosol_even_, sum, &even);
  Multiply(aerosol_odd_, difference, &odd);
  for (int m = 0; m < kAerosolModes; ++m) {
    for (int i = 0; i < kGauss; ++i) {
      source->above[m][i] = (even[m][i] + odd[m][i]) * aerosol;
      source->below[m][i] = (even[m][i] - odd[m][i]) * aerosol;
    }
  }
  Multiply(molecules_even_, sum, &even);
  Multiply(molecules_odd_, difference, &odd);
  for (int m = 0; m < kMoleculeModes; ++m) {
    for (int i = 0; i < kGauss; ++i) {
      source->above[m][i] += (even[m][i] + odd[m][i]) * molecules;
      source->below[m][i] += (even[m][i] - odd[m][i]) * molecules;
    }
  }
}

double Layers::Height(int level) { return kHeights[level]; }

Layers::Layers(const AirMedium& medium) : ground_albedo_(medium.ground_albedo) {
  for (int level = 0; level < kLevels; ++level) {
    const AirMedium::Densities d = medium.DensitiesAt(kHeights[level]);
    const Spectrum extinction = medium.Extinction(d);
    molecule_share_[level] = medium.molecules * d.molecules / extinction;
    aerosol_share_[level] = medium.aerosol_scattering * d.aerosol / extinction;
  }
  const GaussNodes& nodes = Gauss();
  steps_.resize(kLevels - 1);
  for (int layer = 0; layer + 1 < kLevels; ++layer) {
    const double low = kHeights[layer], high = kHeights[layer + 1];
    const AirMedium::Densities mean{
        static_cast<float>(MeanExponential(low, high, AirMedium::kMoleculeScaleHeight)),
        static_cast<float>(MeanExponential(low, high, medium.aerosol.scale_height_m)),
        static_cast<float>(MeanOzone(low, high))};
    const Spectrum depth = medium.Extinction(mean) * static_cast<float>(high - low);
    for (int i = 0; i < kGauss; ++i) {
      Step& step = steps_[layer][i];
      for (int w = 0; w < Spectrum::kSize; ++w) {
        // A source linear in optical depth: Liou 2002, §3.2, integrated by parts.
        const double a = depth.v[w] / nodes.mu[i];
        const double through = std::exp(-a);
        const double mean_through = a > 1e-3 ? (1.0 - through) / a : 1.0 - a / 2.0 + a * a / 6.0;
        step.through.v[w] = static_cast<float>(through);
        step.near.v[w] = static_cast<float>(1.0 - mean_through);
        step.far.v[w] = static_cast<float>(mean_through - through);
      }
    }
  }
}

void Layers::Transport(const Field& source, const Spectrum& ground_direct, Field* radiance) const {
  for (auto& mode : radiance->back().above) mode.fill(Spectrum{});
  for (int layer = kLevels - 2; layer >= 0; --layer) {
    for (int m = 0; m < kAerosolModes; ++m) {
      for (int i = 0; i < kGauss; ++i) {
        const Step& step = steps_[layer][i];
        (*radiance)[layer].above[m][i] = (*radiance)[layer + 1].above[m][i] * step.through +
                                         source[layer + 1].above[m][i] * step.far +
                                         source[layer].above[m][i] * step.near;
      }
    }
  }
  const GaussNodes& nodes = Gauss();
  Spectrum ground = ground_direct;
  for (int i = 0; i < kGauss; ++i) {
    // 2π for the azimuths, albedo/π for the Lambertian ground.
    ground.AddScaled((*radiance)[0].above[0][i],
                     static_cast<float>(2.0 * ground_albedo_ * nodes.weight[i] * nodes.mu[i]));
  }
  for (auto& mode : (*radiance)[0].below) mode.fill(Spectrum{});
  (*radiance)[0].below[0].fill(ground);
  for (int layer = 0; layer + 1 < kLevels; ++layer) {
    for (int m = 0; m < kAerosolModes; ++m) {
      for (int i = 0; i < kGauss; ++i) {
        const Step& step = steps_[layer][i];
        (*radiance)[layer + 1].below[m][i] = (*radiance)[layer].below[m][i] * step.through +
                                             source[layer].below[m][i] * step.far +
                                             source[layer + 1].below[m][i] * step.near;
      }
    }
  }
}

}  // namespace pleinair::sky::internal
