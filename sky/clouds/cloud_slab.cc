#include "sky/clouds/cloud_slab.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pleinair::clouds {
namespace {

/// Depths 2^(k/2 − 6): 1/64 to 1024.
constexpr int kDepths = 33;
constexpr double kFirstDepth = 1.0 / 64.0;
constexpr int kCosines = 17;
constexpr int kColumns = kCosines + 1;

/// Cosines are denser near the horizon, where R of thin layers changes fast: μ₀ = kMin + (1 − kMin)
/// x², x = 0…1.
double CosineAt(int node) {
  const double x = static_cast<double>(node) / (kCosines - 1);
  return SlabTable::kMinCosine + (1.0 - SlabTable::kMinCosine) * x * x;
}
double PlaceOf(double cosine) {
  const double x2 = (cosine - SlabTable::kMinCosine) / (1.0 - SlabTable::kMinCosine);
  return (kCosines - 1) * std::sqrt(std::clamp(x2, 0.0, 1.0));
}

/// Catmull–Rom weights of the nodes −1, 0, 1 and 2 around a place between 0 and 1.
std::array<double, 4> CubicWeights(double t) {
  return {0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (3.0 * t - 5.0),
          0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
}

/// A node beside the ends continues them in a straight line.
template <typename Node>
double CubicThrough(double place, int count, const Node& node) {
  const int cell = std::clamp(static_cast<int>(place), 0, count - 2);
  const std::array<double, 4> weights = CubicWeights(place - cell);
  double sum = 0.0;
  for (int i = -1; i <= 2; ++i) {
    const int at = cell + i;
    const double value = at < 0        ? 2.0 * node(0) - node(1)
                         : at >= count ? 2.0 * node(count - 1) - node(count - 2)
                                       : node(at);
    sum += weights[i + 1] * value;
  }
  return sum;
}

}  // namespace

// R/(1 − R) grows in proportion to τ for thin and for thick layers. Its ratio to τ is smooth in
// log τ, and the table holds the logarithm of that.
SlabTable::SlabTable(const SlabMedium& medium) : nodes_(kDepths * kColumns) {
  std::vector<double> cosines;
  cosines.reserve(kCosines);
  for (int i = 0; i < kCosines; ++i) cosines.push_back(CosineAt(i));
  for (int parity = 0; parity < 2; ++parity) {
    const double first = kFirstDepth * (parity == 0 ? 1.0 : std::sqrt(2.0));
    const auto slabs = DoubleSlab(medium, first, (kDepths + 1 - parity) / 2, cosines);
    double depth = first;
    for (std::size_t k = 0; k < slabs.size(); ++k, depth *= 2.0) {
      double* row = &nodes_[(2 * k + static_cast<std::size_t>(parity)) * kColumns];
      const auto node = [depth](double r) { return std::log(r / (1.0 - r) / depth); };
      for (int i = 0; i < kCosines; ++i) row[i] = node(slabs[k].direct[i].reflected);
      row[kCosines] = node(slabs[k].diffuse_reflected);
    }
  }
}

const SlabTable& SlabTable::Water() {
  static const SlabTable table({kWaterAsymmetry, 1.0});
  return table;
}
const SlabTable& SlabTable::Ice() {
  static const SlabTable table({kIceAsymmetry, 1.0});
  return table;
}

double SlabTable::Interpolated(double depth, double cosine_place) const {
  if (depth <= 0.0) return 0.0;
  const double place = std::clamp(2.0 * std::log2(depth / kFirstDepth), 0.0, kDepths - 1.0);
  const auto row_value = [&](int row) {
    const double* values = &nodes_[static_cast<std::size_t>(row) * kColumns];
    if (cosine_place > kCosines - 1) return values[kCosines];
    return CubicThrough(cosine_place, kCosines, [values](int i) { return values[i]; });
  };
  const double ratio = depth * std::exp(CubicThrough(place, kDepths, row_value));
  return ratio / (1.0 + ratio);
}

double SlabTable::Reflected(double depth, double sun_cosine) const {
  return Interpolated(depth, PlaceOf(sun_cosine));
}

double SlabTable::DiffuseReflected(double depth) const { return Interpolated(depth, kColumns); }

double Unscattered(double depth, double sun_cosine) {
  if (depth <= 0.0) return 1.0;
  return sun_cosine > 0.0 ? std::exp(-depth / sun_cosine) : 0.0;
}

double IlluminanceBelow(const SlabTable& table, double depth, const LightAbove& light,
                        double ground_albedo) {
  const double s = table.DiffuseReflected(depth);
  return (light.sun_horizontal * (1.0 - table.Reflected(depth, light.sun_cosine)) +
          light.sky_horizontal * (1.0 - s)) /
         (1.0 - ground_albedo * s);
}

double DeltaEddingtonReflected(double asymmetry, double depth, double sun_cosine) {
  const double scaled_depth = depth * (1.0 - asymmetry * asymmetry);
  const double scaled_asymmetry = asymmetry / (1.0 + asymmetry);
  const double gamma1 = 0.75 * (1.0 - scaled_asymmetry);
  const double gamma3 = 0.25 * (2.0 - 3.0 * scaled_asymmetry * sun_cosine);
  return (gamma1 * scaled_depth +
          (gamma3 - gamma1 * sun_cosine) * (1.0 - std::exp(-scaled_depth / sun_cosine))) /
         (1.0 + gamma1 * scaled_depth);
}

}  // namespace pleinair::clouds
