// Measures the models' errors against path-traced skies, as a table for docs/measurements/sky.md:
//
//   sky_errors [paths a direction and wavelength, 150]
//
// Each combination of air and sun is traced twice, to measure the truth's own noise.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "base/units.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/perez.h"
#include "tests/sky/reference/sky_comparison.h"

namespace pleinair::sky::reference {
namespace {

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

struct Air {
  const char* name;
  Aerosol aerosol;
  double albedo;
};

std::vector<XyY> PerezAt(const std::vector<Sample>& dome, double turbidity, double sun_deg) {
  const PerezSky sky(turbidity, Towards(0.0, sun_deg));
  return Evaluate(dome,
                  [&](const Sample& s) { return sky.At(Towards(s.azimuth_deg, s.elevation_deg)); });
}

std::vector<XyY> AtmosphereAt(const std::vector<Sample>& dome,
                              const std::shared_ptr<const AtmosphereTables>& tables,
                              double sun_deg) {
  const AtmosphereSky sky(tables, Towards(0.0, sun_deg), 1.0);
  return Evaluate(dome, [&](const Sample& s) {
    return XyYFromXyz(sky.Xyz(Towards(s.azimuth_deg, s.elevation_deg)));
  });
}

/// The turbidity from `low` to `high` with the minimum error.
template <typename SkyOfTurbidity>
Comparison Best(const std::vector<Sample>& dome, const std::vector<XyY>& truth, double low,
                double high, const SkyOfTurbidity& sky) {
  Comparison best;
  best.rmse = 1e9;
  constexpr int kSteps = 50;
  for (int step = 0; step <= kSteps; ++step) {
    const double turbidity = low * std::pow(high / low, static_cast<double>(step) / kSteps);
    const Comparison now = Compare(dome, truth, sky(turbidity));
    if (now.rmse < best.rmse) best = now;
  }
  return best;
}

void Run(int paths) {
  const Air kAirs[] = {
      {"clean", {0.01, 1.4, 1000.0, 0.97, 0.65}, 0.10},
      {"moderate", {0.03, 1.1, 1200.0, 0.93, 0.78}, 0.15},
      {"rural haze", {0.10, 1.3, 1200.0, 0.95, 0.72}, 0.20},
      {"urban haze", {0.18, 1.0, 1500.0, 0.86, 0.70}, 0.20},
      {"dust", {0.35, 0.5, 2000.0, 0.90, 0.80}, 0.30},
      {"T = 20", AerosolOfTurbidity(20.0), 0.15},
  };
  const auto dome = DomeSamples(12, 8);
  std::printf(
      "| air | sun | noise | atmosphere: RMSE, shape, illuminance, x y | by turbidity alone, best: "
      "RMSE, illuminance | perez, best: RMSE, illuminance |\n|---|---|---|---|---|---|\n");
  for (const Air& air : kAirs) {
    const auto tables = std::make_shared<const AtmosphereTables>(air.aerosol, air.albedo);
    for (const double sun : {2.0, 5.0, 15.0, 40.0, 85.0}) {
      const Scene scene{air.aerosol, air.albedo, sun};
      std::vector<XyY> truth = PathTrace(dome, scene, paths, 1);
      const std::vector<XyY> again = PathTrace(dome, scene, paths, 1'000'000);
      const double noise = 0.5 * Compare(dome, truth, again).rmse;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        truth[i] = XyYFromXyz((XyzFromXyY(truth[i]) + XyzFromXyY(again[i])) * 0.5);
      }
      const Comparison ours = Compare(dome, truth, AtmosphereAt(dome, tables, sun));
      const Comparison turbidity = Best(dome, truth, 1.1, 30.0, [&](double t) {
        return AtmosphereAt(
            dome, std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(t), 0.15), sun);
      });
      const Comparison perez =
          Best(dome, truth, 2.0, 10.0, [&](double t) { return PerezAt(dome, t, sun); });
      std::printf("| %s | %.0f° | %.3f | %.3f, %.3f, %.3f, %.4f | %.2f, %.2f | %.2f, %.2f |\n",
                  air.name, sun, noise, ours.rmse, ours.shape_rmse, ours.illuminance,
                  ours.chromaticity, turbidity.rmse, turbidity.illuminance, perez.rmse,
                  perez.illuminance);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace pleinair::sky::reference

int main(int argc, char** argv) {
  const int paths = argc > 1 ? std::atoi(argv[1]) : 150;
  if (paths < 1) {
    std::fprintf(stderr, "usage: sky_errors [paths, at least 1]\n");
    return 2;
  }
  pleinair::sky::reference::Run(paths);
  return 0;
}
