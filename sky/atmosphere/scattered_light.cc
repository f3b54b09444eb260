#include "sky/atmosphere/scattered_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/parallel_for.h"
#include "base/units.h"
#include "sky/atmosphere/scattering_layers.h"

namespace pleinair::sky {
namespace {

using internal::Field;
using internal::kGauss;
using std::numbers::pi;

constexpr int kLevels = ScatteredLight::kLevels;
constexpr int kMoleculeModes = ScatteredLight::kMoleculeModes;
constexpr int kAerosolModes = ScatteredLight::kAerosolModes;
constexpr int kViews = ScatteredLight::kViews;

// Degrees; denser near the horizon, where light changes fast.
constexpr std::array<double, ScatteredLight::kSuns> kSunElevations = {
    -18, -15, -12, -10, -9, -8, -7, -6, -5, -4, -3.5, -3, -2.5, -2, -1.5, -1, -0.5, 0,  0.5, 1,
    1.5, 2,   2.5, 3,   4,  5,  6,  8,  10, 13, 16,   20, 25,   30, 37,   45, 55,   65, 75,  90};

// Orders of scattering that are computed; later orders are summed as a geometric series.
constexpr int kOrders = 10;

// In deep twilight the light grows by e^1.2 per degree of sun elevation.
constexpr double kTwilightGrowth = 1.2;

constexpr double kViewStepDeg = 180.0 / (kViews - 1);

/// Phase functions from the Gaussian directions to the view directions of the table. As
/// internal::PhaseMatrices, but [view][mode][in].
struct ViewMatrices {
  std::array<std::array<std::array<float, kGauss>, kMoleculeModes>, kViews> molecules_above,
      molecules_below;
  std::array<std::array<std::array<float, kGauss>, kAerosolModes>, kViews> aerosol_above,
      aerosol_below;

  explicit ViewMatrices(double asymmetry) {
    const internal::GaussNodes& nodes = internal::Gauss();
    for (int view = 0; view < kViews; ++view) {
      const double mu = std::sin((view * kViewStepDeg - 90.0) * kRadiansPerDegree);
      double total = 0.0;
      for (int j = 0; j < kGauss; ++j) {
        const double weight = 2.0 * pi * nodes.weight[j];
        const auto above = internal::FourierOfAerosol(asymmetry, mu, nodes.mu[j]);
        const auto below = internal::FourierOfAerosol(asymmetry, mu, -nodes.mu[j]);
        for (int m = 0; m < kAerosolModes; ++m) {
          aerosol_above[view][m][j] = static_cast<float>(weight * above[m]);
          aerosol_below[view][m][j] = static_cast<float>(weight * below[m]);
        }
        total += weight * (above[0] + below[0]);
        const auto molecule_above = internal::FourierOfMolecules(mu, nodes.mu[j]);
        const auto molecule_below = internal::FourierOfMolecules(mu, -nodes.mu[j]);
        for (int m = 0; m < kMoleculeModes; ++m) {
          molecules_above[view][m][j] = static_cast<float>(weight * molecule_above[m]);
          molecules_below[view][m][j] = static_cast<float>(weight * molecule_below[m]);
        }
      }
      for (int m = 0; m < kAerosolModes; ++m) {
        for (int j = 0; j < kGauss; ++j) {
          aerosol_above[view][m][j] /= static_cast<float>(total);
          aerosol_below[view][m][j] /= static_cast<float>(total);
        }
      }
    }
  }
};

template <typename Rows, typename Modes>
void Gather(const Rows& above_rows, const Rows& below_rows, const Modes& above, const Modes& below,
            std::size_t modes, Spectrum* out) {
  for (std::size_t m = 0; m < modes; ++m) {
    Spectrum sum{};
    for (int j = 0; j < kGauss; ++j) {
      sum.AddScaled(above[m][j], above_rows[m][j]);
      sum.AddScaled(below[m][j], below_rows[m][j]);
    }
    out[m] = sum;
  }
}

/// Source function of singly scattered sunlight.
void FirstSource(const internal::Layers& layers, const std::array<Spectrum, kLevels>& sun,
                 double asymmetry, double mu_sun, Field* source) {
  const internal::GaussNodes& nodes = internal::Gauss();
  std::array<std::array<internal::AerosolFourier, kGauss>, 2> aerosol;
  double total = 0.0;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < kGauss; ++i) {
      aerosol[side][i] =
          internal::FourierOfAerosol(asymmetry, side == 0 ? nodes.mu[i] : -nodes.mu[i], mu_sun);
      total += 2.0 * pi * nodes.weight[i] * aerosol[side][i][0];
    }
  }
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < kGauss; ++i) {
      const double mu = side == 0 ? nodes.mu[i] : -nodes.mu[i];
      const internal::MoleculeFourier molecules = internal::FourierOfMolecules(mu, mu_sun);
      for (int m = 0; m < kAerosolModes; ++m) {
        const double twice = m == 0 ? 1.0 : 2.0;
        const auto a = static_cast<float>(twice * aerosol[side][i][m] / total);
        const auto b = static_cast<float>(m < kMoleculeModes ? twice * molecules[m] : 0.0);
        for (int level = 0; level < kLevels; ++level) {
          Spectrum value = layers.AerosolShare(level) * a;
          value.AddScaled(layers.MoleculeShare(level), b);
          value *= sun[level];
          internal::LevelField& field = (*source)[level];
          (side == 0 ? field.above : field.below)[m][i] = value;
        }
      }
    }
  }
}

void Add(const Field& field, const Spectrum& factor, Field* total) {
  for (int level = 0; level < kLevels; ++level) {
    for (int m = 0; m < kAerosolModes; ++m) {
      for (int i = 0; i < kGauss; ++i) {
        (*total)[level].above[m][i] += field[level].above[m][i] * factor;
        (*total)[level].below[m][i] += field[level].below[m][i] * factor;
      }
    }
  }
}

/// Total light over all directions and levels; its ratio between orders gives the geometric series.
Spectrum Amount(const Field& field) {
  Spectrum sum{};
  for (const internal::LevelField& level : field) {
    for (int i = 0; i < kGauss; ++i) sum += level.above[0][i] + level.below[0][i];
  }
  return sum;
}

}  // namespace

void ScatteredLight::Source::AddScaled(const Source& o, float s) {
  for (int m = 0; m < kMoleculeModes; ++m) molecules[m].AddScaled(o.molecules[m], s);
  for (int m = 0; m < kAerosolModes; ++m) aerosol[m].AddScaled(o.aerosol[m], s);
}

double ScatteredLight::SunElevationDeg(int sun) { return kSunElevations[sun]; }

ScatteredLight::Place ScatteredLight::PlaceOfSun(double elevation_deg) {
  if (elevation_deg <= kSunElevations.front()) return {0, 0.0F};
  const auto above = std::upper_bound(kSunElevations.begin(), kSunElevations.end(), elevation_deg);
  if (above == kSunElevations.end()) return {kSuns - 2, 1.0F};
  const auto lower = static_cast<int>(above - kSunElevations.begin()) - 1;
  const double low = kSunElevations[lower], step = kSunElevations[lower + 1] - low;
  const double share = (elevation_deg - low) / step;
  // Below the horizon light falls by a factor of e per degree, just above it more slowly.
  // Exponential interpolation leaves no kinks at the nodes.
  const double growth = low < 0.0 ? step * kTwilightGrowth : 0.0;
  return {lower, static_cast<float>(growth > 0.0 ? std::expm1(growth * share) / std::expm1(growth)
                                                 : share)};
}

ScatteredLight::ScatteredLight(const AirMedium& medium, const OpticalDepthTable& depths)
    : table_(static_cast<std::size_t>(kSuns) * kLevels * kViews) {
  const internal::Layers layers(medium);
  const double asymmetry = medium.aerosol.asymmetry;
  const internal::PhaseMatrices phases(asymmetry);
  const ViewMatrices views(asymmetry);
  ParallelFor(kSuns, 0, [&](std::size_t s) {
    Field source(kLevels), radiance(kLevels), total(kLevels);
    const double mu_sun = std::sin(kSunElevations[s] * kRadiansPerDegree);
    std::array<Spectrum, kLevels> sun;
    for (int level = 0; level < kLevels; ++level) {
      sun[level] = depths.SunTransmittance(internal::Layers::Height(level), mu_sun);
    }
    FirstSource(layers, sun, asymmetry, mu_sun, &source);
    const auto reflected = static_cast<float>(medium.ground_albedo * std::max(0.0, mu_sun) / pi);
    layers.Transport(source, sun[0] * reflected, &radiance);
    total = radiance;
    Spectrum before = Amount(radiance);
    for (int order = 2; order <= kOrders; ++order) {
      for (int level = 0; level < kLevels; ++level) {
        phases.Scatter(radiance[level], layers.MoleculeShare(level), layers.AerosolShare(level),
                       &source[level]);
      }
      layers.Transport(source, Spectrum{}, &radiance);
      const Spectrum now = Amount(radiance);
      Spectrum factor = Spectrum::Of(1.0F);
      if (order == kOrders) {
        for (int w = 0; w < Spectrum::kSize; ++w) {
          const float ratio = before.v[w] > 0.0F ? std::min(now.v[w] / before.v[w], 0.95F) : 0.0F;
          factor.v[w] = 1.0F / (1.0F - ratio);
        }
      }
      Add(radiance, factor, &total);
      before = now;
    }
    for (int level = 0; level < kLevels; ++level) {
      for (int view = 0; view < kViews; ++view) {
        Source& out = table_[(s * kLevels + level) * kViews + view];
        Gather(views.molecules_above[view], views.molecules_below[view], total[level].above,
               total[level].below, kMoleculeModes, out.molecules.data());
        Gather(views.aerosol_above[view], views.aerosol_below[view], total[level].above,
               total[level].below, kAerosolModes, out.aerosol.data());
      }
    }
  });
}

ScatteredLight::Source ScatteredLight::At(int sun, double height_m,
                                          double view_elevation_deg) const {
  int level = 0;
  while (level + 2 < kLevels && height_m > internal::Layers::Height(level + 1)) ++level;
  const double low = internal::Layers::Height(level), high = internal::Layers::Height(level + 1);
  const auto up = static_cast<float>(std::clamp((height_m - low) / (high - low), 0.0, 1.0));
  const double place = std::clamp((view_elevation_deg + 90.0) / kViewStepDeg, 0.0, kViews - 1.0);
  const int view = std::min(static_cast<int>(place), kViews - 2);
  const auto along = static_cast<float>(place - view);
  Source source{};
  source.AddScaled(Node(sun, level, view), (1.0F - up) * (1.0F - along));
  source.AddScaled(Node(sun, level, view + 1), (1.0F - up) * along);
  source.AddScaled(Node(sun, level + 1, view), up * (1.0F - along));
  source.AddScaled(Node(sun, level + 1, view + 1), up * along);
  return source;
}

}  // namespace pleinair::sky
