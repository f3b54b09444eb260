#include "sky/atmosphere/spectral_bands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sky/cie_observer.h"

namespace pleinair::sky {
namespace {

constexpr int kNodes = Spectrum::kSize;

// At the wavelengths of kCie1931. Sun: ASTM G-173, extraterrestrial column, W m⁻² nm⁻¹, means over
// the 10 nm from the wavelength on. Ozone: Serdyuchenko et al. (Universität Bremen, 2011), 233 K,
// means over the same 10 nm, 1e-27 m².
struct Measured {
  double solar, ozone;
};
constexpr std::array<Measured, kCie1931.size()> kMeasured = {{
    {1.01249, 0.2818}, {1.14716, 0.6636}, {1.72765, 1.527}, {1.73054, 2.763}, {1.6887, 5.52},
    {1.61253, 8.451},  {1.91198, 15.82},  {2.03474, 23.16}, {2.02042, 36.69}, {2.02212, 49.24},
    {1.93377, 77.52},  {1.95809, 90.16},  {1.91686, 148.0}, {1.8298, 160.2},  {1.8685, 213.9},
    {1.8931, 275.5},   {1.85149, 309.1},  {1.8504, 350.0},  {1.8341, 426.6},  {1.8345, 467.2},
    {1.8147, 439.8},   {1.78158, 470.1},  {1.7533, 501.9},  {1.6965, 430.5},  {1.68194, 374.0},
    {1.64654, 321.5},  {1.6048, 266.2},   {1.52143, 223.8}, {1.55622, 185.2}, {1.5113, 147.3},
    {1.474, 120.9},    {1.4482, 94.23},   {1.41018, 74.55}, {1.36775, 65.66}, {1.34188, 51.05},
    {1.31429, 41.5},   {1.28303, 42.28},  {1.26758, 32.37},
}};

template <typename Member>
double Interpolate(double wavelength_nm, Member member) {
  const double place = (wavelength_nm - kCie1931.front().wavelength_nm) / kObserverStepNm;
  const double last = static_cast<double>(kMeasured.size()) - 1.0;
  const double clamped = std::clamp(place, 0.0, last);
  const auto i = std::min(static_cast<std::size_t>(clamped), kMeasured.size() - 2);
  const double t = clamped - static_cast<double>(i);
  return std::lerp(kMeasured[i].*member, kMeasured[i + 1].*member, t);
}

/// Second derivatives at the nodes (unit spacing) of the natural cubic spline that is 1 at node
/// `one` and 0 at the others; Thomas' algorithm on m[i−1] + 4 m[i] + m[i+1] = 6 Δ²y.
std::array<double, kNodes> SplineCurvature(int one) {
  const auto y = [&](int i) { return i == one ? 1.0 : 0.0; };
  std::array<double, kNodes> upper{}, right{}, m{};
  for (int i = 1; i < kNodes - 1; ++i) {
    const double d = 6.0 * (y(i - 1) - 2.0 * y(i) + y(i + 1));
    const double pivot = 4.0 - upper[i - 1];
    upper[i] = 1.0 / pivot;
    right[i] = (d - right[i - 1]) / pivot;
  }
  for (int i = kNodes - 2; i > 0; --i) m[i] = right[i] - upper[i] * m[i + 1];
  return m;
}

double SplineBasis(int node, const std::array<double, kNodes>& curvature, double place) {
  const int i = std::clamp(static_cast<int>(place), 0, kNodes - 2);
  const double b = place - i, a = 1.0 - b;
  const double y0 = i == node ? 1.0 : 0.0, y1 = i + 1 == node ? 1.0 : 0.0;
  return a * y0 + b * y1 +
         ((a * a * a - a) * curvature[i] + (b * b * b - b) * curvature[i + 1]) / 6.0;
}

/// XYZ in lux for a ratio of 1 at one node. Beyond the nodes the ratio is constant.
std::array<Vec3, kNodes> ComputeWeights() {
  std::array<Vec3, kNodes> weights{};
  for (int node = 0; node < kNodes; ++node) {
    const std::array<double, kNodes> curvature = SplineCurvature(node);
    for (std::size_t i = 0; i < kCie1931.size(); ++i) {
      const ObserverBand& band = kCie1931[i];
      const double place = std::clamp((band.wavelength_nm - kFirstWavelengthNm) /
                                          (kLastWavelengthNm - kFirstWavelengthNm) * (kNodes - 1),
                                      0.0, kNodes - 1.0);
      const double lux = kLumensPerWatt * kObserverStepNm * kMeasured[i].solar *
                         SplineBasis(node, curvature, place);
      weights[node] = weights[node] + Vec3{band.x, band.y, band.z} * lux;
    }
  }
  return weights;
}

}  // namespace

Vec3 XyzOfSolarRatio(const Spectrum& ratio) {
  static const std::array<Vec3, kNodes> kWeights = ComputeWeights();
  Vec3 xyz;
  for (int i = 0; i < kNodes; ++i) xyz = xyz + kWeights[i] * static_cast<double>(ratio.v[i]);
  return xyz;
}

double OzoneCrossSection(double wavelength_nm) {
  return 1e-27 * Interpolate(wavelength_nm, &Measured::ozone);
}

double SolarIrradiance(double wavelength_nm) {
  return Interpolate(wavelength_nm, &Measured::solar);
}

}  // namespace pleinair::sky
