#include <benchmark/benchmark.h>

#include <cmath>

#include "sky/daylight.h"
#include "sky/spherical_harmonics.h"
#include "sky/sun_position.h"

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

const SunPosition kSun{FromDegrees(180.0), FromDegrees(40.0), FromDegrees(40.0), 1.0};

void CreateLight(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(CreateDaylight(kSun, {}));
}
BENCHMARK(CreateLight);

void EvaluateSky(benchmark::State& state, SkyCondition condition) {
  const auto light = CreateDaylight(kSun, {condition, 0.0});
  double azimuth = 0.0;
  for (auto _ : state) {
    azimuth += 0.1;
    benchmark::DoNotOptimize(
        light->SkyRadiance({{0.6 * std::sin(azimuth), 0.6 * std::cos(azimuth), 0.8}}));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(EvaluateSky, clear, SkyCondition::kClear);
BENCHMARK_CAPTURE(EvaluateSky, overcast, SkyCondition::kOvercast);

void ProjectHarmonics(benchmark::State& state) {
  const auto light = CreateDaylight(kSun, {});
  for (auto _ : state) benchmark::DoNotOptimize(ProjectSky(*light));
}
BENCHMARK(ProjectHarmonics);

}  // namespace
}  // namespace pleinair::sky

BENCHMARK_MAIN();
