#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "sky/atmosphere/atmosphere.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::sky {
namespace {

constexpr Observer kPrague{.latitude = FromDegrees(50.0875), .longitude = FromDegrees(14.4213)};

void ComputeSun(benchmark::State& state, SunModel model) {
  std::int64_t hour = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        ComputeSunPosition(kPrague, UtcTime(++hour * 3'600'000'000'000), model));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(ComputeSun, precise, SunModel::kPrecise);
BENCHMARK_CAPTURE(ComputeSun, paper, SunModel::kPaper);

constexpr SkyModelName kPerez{SkyModelKind::kPerez, 0}, kCie12{SkyModelKind::kCie, 12},
    kAtmosphere{SkyModelKind::kAtmosphere, 0};

Direction<World> SunAt(double elevation_deg) {
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{0.0, std::cos(elevation), std::sin(elevation)}};
}

std::unique_ptr<SkyModel> Sky(SkyModelName name) {
  return *CreateSkyModel(name, {}, SunAt(40.0), 1.0);
}

/// Radiance in directions over the whole dome.
void LookUpRadiance(benchmark::State& state, SkyModelName name) {
  const auto sky = Sky(name);
  benchmark::DoNotOptimize(sky->SkyHorizontalIrradiance());
  std::array<Direction<World>, 256> directions;
  for (int i = 0; i < 256; ++i) {
    const double up = (i + 0.5) / 256, level = std::sqrt(1.0 - up * up), turn = i * 2.39996323;
    directions[i] = {{level * std::cos(turn), level * std::sin(turn), up}};
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(sky->SkyRadiance(directions[++i % 256]));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(LookUpRadiance, perez, kPerez);
BENCHMARK_CAPTURE(LookUpRadiance, cie12, kCie12);
BENCHMARK_CAPTURE(LookUpRadiance, atmosphere, kAtmosphere);

/// All tables that depend only on the air.
void BuildTables(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(AtmosphereTables(AerosolOfTurbidity(kDefaultTurbidity), 0.15));
  }
}
BENCHMARK(BuildTables)->Unit(benchmark::kMillisecond);

/// The sky-view table after the sun has moved.
void MoveSun(benchmark::State& state) {
  const auto tables =
      std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(kDefaultTurbidity), 0.15);
  double elevation = 5.0;
  for (auto _ : state) {
    elevation = elevation < 60.0 ? elevation + 0.1 : 5.0;
    benchmark::DoNotOptimize(AtmosphereSky(tables, SunAt(elevation), 1.0));
  }
}
BENCHMARK(MoveSun)->Unit(benchmark::kMillisecond);

/// Only the sun's light, as a moving shadow needs it in every frame.
void MoveSunAlone(benchmark::State& state) {
  const auto source = *SkySource::Create(kAtmosphere, {});
  double elevation = 5.0;
  for (auto _ : state) {
    elevation = elevation < 60.0 ? elevation + 0.1 : 5.0;
    benchmark::DoNotOptimize(source->ForSun(SunAt(elevation), 1.0)->SunNormalIrradiance());
  }
}
BENCHMARK(MoveSunAlone);

void SeeThroughAir(benchmark::State& state) {
  const AtmosphereTables tables(AerosolOfTurbidity(kDefaultTurbidity), 0.15);
  const AerialPerspective air(tables, SunAt(40.0), 1.0);
  double distance = 1.0;
  for (auto _ : state) {
    distance = distance < 1e4 ? distance * 1.01 : 1.0;
    benchmark::DoNotOptimize(air.Inscattered({{0.6, 0.8, 0.0}}, Metres(distance)));
  }
}
BENCHMARK(SeeThroughAir);

}  // namespace
}  // namespace pleinair::sky

BENCHMARK_MAIN();
