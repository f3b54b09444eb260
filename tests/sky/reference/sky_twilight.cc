// Measures skylight on level ground through twilight, as a table for docs/measurements/sky.md:
//
//   sky_twilight [paths a direction and wavelength, 100]
//
// Compares `atmosphere`, by default and in haze, the path tracer down to −9° (which has no
// starlight), and the almanac.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "base/units.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/atmosphere/twilight.h"
#include "sky/dome.h"
#include "sky/sky_model.h"
#include "tests/sky/reference/sky_comparison.h"

namespace pleinair::sky::reference {
namespace {

double Lux(double turbidity, double sun_deg) {
  const double sun = sun_deg * kRadiansPerDegree;
  const AtmosphereSky sky(
      std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(turbidity), 0.15),
      {{0.0, std::cos(sun), std::sin(sun)}}, 1.0);
  return IntegrateProjectedDome([&](Direction<World> from) { return sky.Xyz(from).y; });
}

double TracedLux(double turbidity, double sun_deg, int paths) {
  const auto dome = DomeSamples(12, 8);
  const auto truth = PathTrace(dome, {AerosolOfTurbidity(turbidity), 0.15, sun_deg}, paths, 1);
  double lux = 0.0;
  for (std::size_t i = 0; i < dome.size(); ++i) {
    lux +=
        dome[i].weight * truth[i].luminance * std::sin(dome[i].elevation_deg * kRadiansPerDegree);
  }
  return lux;
}

void Run(int paths) {
  // Seidelmann 1992, Table 8.2: TwilightShare() times its light at 0°.
  const double at_sunset = std::pow(10.0, 2.88);
  std::printf(
      "| sun | T = 1.8 | T = 8 | path tracer, T = 1.8 | almanac |\n|---|---|---|---|---|\n");
  for (const double sun : {0.0,   -1.0,  -2.0,  -3.0,  -4.0,  -5.0,  -6.0,  -7.0,  -8.0,  -9.0,
                           -10.0, -11.0, -12.0, -13.0, -14.0, -15.0, -16.0, -17.0, -18.0, -25.0}) {
    std::printf("| %.0f° | %.3g | %.3g |", sun, Lux(kDefaultTurbidity, sun), Lux(8.0, sun));
    if (sun >= -9.0) {
      std::printf(" %.3g |", TracedLux(kDefaultTurbidity, sun, paths));
    } else {
      std::printf(" |");
    }
    std::printf(" %.3g |\n", at_sunset * TwilightShare(Radians(sun * kRadiansPerDegree)));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace pleinair::sky::reference

int main(int argc, char** argv) {
  const int paths = argc > 1 ? std::atoi(argv[1]) : 100;
  if (paths < 1) {
    std::fprintf(stderr, "usage: sky_twilight [paths, at least 1]\n");
    return 2;
  }
  pleinair::sky::reference::Run(paths);
  return 0;
}
