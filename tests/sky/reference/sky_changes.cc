// Measures how fast the sky of `atmosphere` changes in 0.1°, for docs/measurements/sky.md:
//
//   sky_changes [paths a direction and wavelength, 4000]
//
// First the steepest change between adjacent directions, for suns of −6° to 90°. Then the steepest
// change as the sun moves, with the path tracer's change at the same place. Both of its suns use
// the same paths, so that their ratio has little noise.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "base/units.h"
#include "sky/atmosphere/atmosphere.h"
#include "tests/sky/reference/path_traced_sky.h"

namespace pleinair::sky::reference {
namespace {

constexpr double kStepDeg = 0.1;

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

std::shared_ptr<const AtmosphereTables> TablesOf(double turbidity, double albedo) {
  return std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(turbidity), albedo);
}

struct Steepest {
  double change = 0.0, sun = 0.0, azimuth = 0.0, elevation = 0.0;
  void Offer(const Steepest& o) {
    if (o.change > change) *this = o;
  }
};

/// Of the luminance, and of the color channels relative to the brightest.
struct Changes {
  Steepest luminance, color;
};

double LuminanceChange(Vec3 a, Vec3 b) { return std::max(a.y / b.y, b.y / a.y) - 1.0; }

double ColorChange(Vec3 a, Vec3 b) {
  const LinearRgb p = RgbInGamut(a), q = RgbInGamut(b);
  const double most = std::max({std::fabs(p.r - q.r), std::fabs(p.g - q.g), std::fabs(p.b - q.b)});
  return most / std::min(std::max({p.r, p.g, p.b}), std::max({q.r, q.g, q.b}));
}

void Sweep(const AtmosphereSky& sky, double sun, Changes* changes) {
  const auto look = [&](double azimuth, double elevation, double next_azimuth,
                        double next_elevation) {
    const Vec3 a = sky.Xyz(Towards(azimuth, elevation));
    const Vec3 b = sky.Xyz(Towards(next_azimuth, next_elevation));
    changes->luminance.Offer({LuminanceChange(a, b), sun, azimuth, elevation});
    changes->color.Offer({ColorChange(a, b), sun, azimuth, elevation});
  };
  for (const double azimuth : {0.0, 0.5, 1.0, 2.0, 5.0, 15.0, 40.0, 90.0, 130.0, 180.0}) {
    // Steps of 0.05° below 15° and of 0.1° above.
    for (int i = 0; i < 1050; ++i) {
      const double e = i < 300 ? 0.05 * i : 15.0 + 0.1 * (i - 300);
      look(azimuth, e, azimuth, std::min(e + kStepDeg, 90.0));
    }
  }
  for (const double elevation : {0.0, 0.5, 1.0, 2.0, 5.0, 20.0, 45.0, 80.0, 89.8}) {
    for (int i = 0; i < 1800; ++i) {
      const double a = 0.1 * i;
      if (a > 20.0 && elevation < 70.0 && i % 10 != 0) continue;
      look(a, elevation, a + kStepDeg, elevation);
    }
  }
}

void PrintDirections() {
  std::printf("| turbidity | luminance | at | colour | at |\n|---|---|---|---|---|\n");
  const auto place = [](const Steepest& s) {
    char text[80];
    std::snprintf(text, sizeof text, "sun %.1f°, %.1f° from it, %.2f° up", s.sun, s.azimuth,
                  s.elevation);
    return std::string(text);
  };
  for (const double turbidity :
       {1.5, 1.65, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0, 3.3, 3.7, 4.2, 5.0, 7.0, 10.0, 20.0}) {
    Changes changes;
    for (const double albedo : {0.0, 0.15, 1.0}) {
      const auto tables = TablesOf(turbidity, albedo);
      for (double sun = -6.0; sun <= 90.0;) {
        Sweep(AtmosphereSky(tables, Towards(0.0, sun), 1.0), sun, &changes);
        sun += sun < -1.0 ? 0.5 : (sun < 2.5 ? 0.13 : (sun < 8.0 ? 0.5 : 6.0));
      }
    }
    std::printf("| %g | %.2f %% | %s | %.2f %% | %s |\n", turbidity,
                100.0 * changes.luminance.change, place(changes.luminance).c_str(),
                100.0 * changes.color.change, place(changes.color).c_str());
    std::fflush(stdout);
  }
}

struct Move {
  double turbidity, sun, azimuth, elevation;
};

/// Mean and standard error of the path tracer's change of luminance as the sun rises by kStepDeg.
struct Traced {
  double change = 0.0, error = 0.0;
};
Traced Trace(const Move& move, double elevation, int paths) {
  constexpr int kBatches = 10;
  const Aerosol aerosol = AerosolOfTurbidity(move.turbidity);
  const PathTracedSky before({aerosol, 0.15, move.sun});
  const PathTracedSky after({aerosol, 0.15, move.sun + kStepDeg});
  std::array<double, kBatches> low{}, high{};
  double low_sum = 0.0, high_sum = 0.0;
  for (int i = 0; i < kBatches; ++i) {
    low[i] = before.At(elevation, move.azimuth, paths / kBatches, 1 + i).luminance;
    high[i] = after.At(elevation, move.azimuth, paths / kBatches, 1 + i).luminance;
    low_sum += low[i];
    high_sum += high[i];
  }
  const double ratio = high_sum / low_sum;
  double square = 0.0;
  for (int i = 0; i < kBatches; ++i) square += std::pow(high[i] - ratio * low[i], 2);
  return {ratio - 1.0, std::sqrt(square * kBatches / (kBatches - 1)) / low_sum};
}

void PrintMoves(int paths) {
  std::printf(
      "\n| turbidity | sun | from it, up | atmosphere | path tracer |\n|---|---|---|---|---|\n");
  for (const Move& move :
       {Move{1.5, -6.0, 180.0, 40.0}, Move{1.8, -6.0, 180.0, 40.0}, Move{1.8, -6.0, 0.0, 10.0},
        Move{1.8, -4.1, 180.0, 20.0}, Move{1.8, -2.6, 180.0, 10.0}, Move{1.5, -0.1, 0.0, 0.0},
        Move{1.8, 0.0, 0.0, 3.0}, Move{1.8, 0.4, 0.0, 0.0}, Move{2.34, 1.0, 0.0, 0.0},
        Move{2.34, 1.5, 0.0, 0.0}, Move{3.5, 3.0, 0.0, 0.0}, Move{3.5, 2.0, 0.0, 5.0},
        Move{8.0, 1.5, 0.0, 10.0}, Move{20.0, 0.0, 0.0, 20.0}}) {
    const auto tables = TablesOf(move.turbidity, 0.15);
    const auto at = [&](double sun) {
      return AtmosphereSky(tables, Towards(0.0, sun), 1.0)
          .Xyz(Towards(move.azimuth, move.elevation))
          .y;
    };
    const double ours = at(move.sun + kStepDeg) / at(move.sun) - 1.0;
    const double seen = AtmosphereSky::SoftenedElevation(move.elevation * kRadiansPerDegree,
                                                         move.sun * kRadiansPerDegree) /
                        kRadiansPerDegree;
    const Traced truth = Trace(move, seen, paths);
    std::printf("| %g | %.1f → %.1f° | %.0f°, %.0f° | %.1f %% | %.1f ± %.1f %% |\n", move.turbidity,
                move.sun, move.sun + kStepDeg, move.azimuth, move.elevation, 100.0 * ours,
                100.0 * truth.change, 100.0 * truth.error);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace pleinair::sky::reference

int main(int argc, char** argv) {
  const int paths = argc > 1 ? std::atoi(argv[1]) : 4000;
  if (paths < 10) {
    std::fprintf(stderr, "usage: sky_changes [paths, at least 10]\n");
    return 2;
  }
  pleinair::sky::reference::PrintDirections();
  pleinair::sky::reference::PrintMoves(paths);
  return 0;
}
