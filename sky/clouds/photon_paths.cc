#include "sky/clouds/photon_paths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "base/parallel_for.h"
#include "sky/clouds/cloud_noise.h"

namespace pleinair::clouds {
namespace {

using Random = std::mt19937_64;

/// Evenly in 0…1, the same on every machine.
double Uniform(Random* random) { return static_cast<double>((*random)() >> 11U) * 0x1.0p-53; }

/// Another direction by Henyey–Greenstein's phase function (Witt 1977).
Vec3 Scattered(Vec3 along, double g, Random* random) {
  const double u = Uniform(random);
  double cosine = 2.0 * u - 1.0;
  if (std::fabs(g) > 1e-3) {
    const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    cosine = (1.0 + g * g - s * s) / (2.0 * g);
  }
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double turn = 2.0 * std::numbers::pi * Uniform(random);
  const Vec3 aside = std::fabs(along.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 x = Normalized(Cross(along, aside)), y = Cross(along, x);
  return Normalized(along * cosine + x * (sine * std::cos(turn)) + y * (sine * std::sin(turn)));
}

enum class End { kReflected, kTransmitted, kDirect, kAbsorbed };

End FollowPhoton(const CloudVolume& cloud, Vec3 to_sun, Random* random) {
  Vec3 at{cloud.side_m * Uniform(random), cloud.side_m * Uniform(random), cloud.top_m};
  Vec3 along = to_sun * -1.0;
  bool scattered = false;
  while (true) {
    at = at + along * (-std::log1p(-Uniform(random)) / cloud.most_extinction);
    if (at.z > cloud.top_m) return End::kReflected;
    if (at.z < cloud.bottom_m) return scattered ? End::kTransmitted : End::kDirect;
    if (Uniform(random) * cloud.most_extinction >= cloud.extinction(at)) continue;
    if (Uniform(random) >= cloud.single_scattering_albedo) return End::kAbsorbed;
    scattered = true;
    along = Scattered(along, cloud.asymmetry, random);
  }
}

}  // namespace

PhotonFluxes TracePhotons(const CloudVolume& cloud, Vec3 to_sun, int photons, std::uint64_t seed) {
  PhotonFluxes fluxes;
  if (cloud.most_extinction <= 0.0) {
    fluxes.transmitted = fluxes.direct = 1.0;
    return fluxes;
  }
  constexpr int kGroup = 500;
  const auto groups = static_cast<std::size_t>((photons + kGroup - 1) / kGroup);
  std::vector<PhotonFluxes> counts(groups);
  ParallelFor(groups, 0, [&](std::size_t group) {
    Random random(MixSeeds(seed, group));
    const int count = std::min(kGroup, photons - static_cast<int>(group) * kGroup);
    for (int i = 0; i < count; ++i) {
      const End end = FollowPhoton(cloud, to_sun, &random);
      counts[group].reflected += end == End::kReflected ? 1.0 : 0.0;
      counts[group].transmitted += end == End::kTransmitted || end == End::kDirect ? 1.0 : 0.0;
      counts[group].direct += end == End::kDirect ? 1.0 : 0.0;
      counts[group].absorbed += end == End::kAbsorbed ? 1.0 : 0.0;
    }
  });
  const double each = 1.0 / photons;
  for (const PhotonFluxes& count : counts) {
    fluxes.reflected += count.reflected * each;
    fluxes.transmitted += count.transmitted * each;
    fluxes.direct += count.direct * each;
    fluxes.absorbed += count.absorbed * each;
  }
  const double most = std::max({fluxes.reflected, fluxes.transmitted, fluxes.absorbed});
  fluxes.error = std::sqrt(most * (1.0 - most) * each);
  return fluxes;
}

double StepCloud::Depth(double x_m) {
  const double place = x_m / kPeriod_m - std::floor(x_m / kPeriod_m);
  return place < 0.5 ? kThin : kThick;
}

double StepCloud::DepthAlong(double x_m, Vec3 to_sun) {
  // The column depth, integrated from 0 to x.
  const auto integral = [](double x) {
    const double periods = std::floor(x / kPeriod_m), rest = x - periods * kPeriod_m;
    const double half = 0.5 * kPeriod_m;
    return periods * half * (kThin + kThick) + std::min(rest, half) * kThin +
           std::max(0.0, rest - half) * kThick;
  };
  const double travel = kThickness_m * to_sun.x / to_sun.z;
  if (std::fabs(travel) < 1e-6) return Depth(x_m) / to_sun.z;
  return (integral(x_m + travel) - integral(x_m)) / travel / to_sun.z;
}

CloudVolume StepCloud::Volume() {
  CloudVolume cloud;
  cloud.extinction = [](Vec3 at) { return Depth(at.x) / kThickness_m; };
  cloud.most_extinction = kThick / kThickness_m;
  cloud.top_m = kThickness_m;
  cloud.side_m = kPeriod_m;
  return cloud;
}

}  // namespace pleinair::clouds
