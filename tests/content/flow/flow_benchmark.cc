// Times of flow fields: docs/measurements/flow.md states them.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "content/flow/even_placement.h"
#include "content/flow/flow_levels.h"
#include "content/flow/line_integral_convolution.h"
#include "content/flow/line_integrator.h"
#include "content/flow/nearest_levels.h"
#include "content/flow/particles.h"
#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

Vec3 Gyres(const Vec3& p) {
  constexpr double kPi = std::numbers::pi;
  return {-std::sin(3.0 * kPi * p.x) * std::cos(3.0 * kPi * p.y),
          std::cos(3.0 * kPi * p.x) * std::sin(3.0 * kPi * p.y), 0.0};
}

std::vector<Seed> SeedsIn(const Box& box, std::size_t count) {
  std::vector<Seed> seeds;
  for (std::size_t i = 0; i < count; ++i) seeds.push_back({Birthplace(box, i)});
  return seeds;
}

/// f.1: levels of 64, 128 and 256 steps.
void BuildLevels(benchmark::State& state) {
  const auto field = MakeSteady(Square(static_cast<int>(state.range(0)), 1.0), Gyres);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        FlowLevels::Build(*field, 0.0, 0.002, static_cast<int>(state.range(1)), 1));
  }
}
BENCHMARK(BuildLevels)->ArgsProduct({{1024, 2048}, {6, 7, 8}})->Unit(benchmark::kMillisecond);

/// The published map of nearest nodes.
void BuildNearestLevels(benchmark::State& state) {
  const auto field = MakeSteady(Square(static_cast<int>(state.range(0)), 1.0), Gyres);
  for (auto _ : state) benchmark::DoNotOptimize(NearestLevels::Build(*field, 0.0, 0.002, 6));
}
BENCHMARK(BuildNearestLevels)->Arg(1024)->Arg(2048)->Unit(benchmark::kMillisecond);

/// f.1: 10,000 trajectories of 64 points from levels.
void RebuildTrajectories(benchmark::State& state) {
  const auto field = MakeSteady(Square(1024, 1.0), Gyres);
  const auto levels = FlowLevels::Build(*field, 0.0, 0.002, 6);
  const std::vector<Seed> seeds = SeedsIn(field->bounds(), 10000);
  for (auto _ : state) {
    for (const Seed& seed : seeds) {
      for (std::uint32_t n = 0; n < 64; ++n) benchmark::DoNotOptimize(levels->After(seed.point, n));
    }
  }
  state.SetItemsProcessed(state.iterations() * 640000);
}
BENCHMARK(RebuildTrajectories)->Unit(benchmark::kMillisecond);

/// f.6: 10,000 lines of ABC flow in 128³ over 250 cells, one thread.
void TraceAbc(benchmark::State& state) {
  const double cell = 2.0 * std::numbers::pi / 128.0;
  const GridAxis axis = GridAxis::Closed(0.0, cell, 128);
  const auto field =
      MakeSteady({{axis, axis, axis}, {}}, AbcFlow,
                 state.range(0) == 0 ? Interpolation::kLinear : Interpolation::kCubic);
  const std::vector<Seed> seeds = SeedsIn(field->bounds(), 10000);
  std::size_t vertices = 0;
  for (auto _ : state) {
    const auto lines = TraceLines(*field, seeds, {.length_m = 250.0 * cell, .threads = 1});
    vertices = 0;
    for (const FlowLine& line : *lines) vertices += line.points.size();
  }
  state.counters["vertices"] = static_cast<double>(vertices);
}
BENCHMARK(TraceAbc)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// f.6: even placement on 512², one thread.
void PlaceEvenly(benchmark::State& state) {
  const auto field = MakeSteady(Square(512, 1.0), Gyres);
  for (auto _ : state) {
    const auto lines =
        PlaceLines(*field, 2.0 / static_cast<double>(state.range(0)), {.threads = 1});
    state.counters["lines"] = static_cast<double>(lines->size());
  }
}
BENCHMARK(PlaceEvenly)->Arg(40)->Arg(80)->Unit(benchmark::kMillisecond);

/// f.6: textures of 1024² with 2 × 64 steps; 0: by levels, 1: serially.
void Convolve(benchmark::State& state) {
  const auto field = MakeSteady(Square(257, 1.0), Gyres);
  const ConvolutionOptions options{.width = 1024, .height = 1024, .threads = 1};
  Image<float> image;
  for (auto _ : state) {
    image = *(state.range(0) == 0 ? ConvolveByLevels(*field, 0.0, options)
                                  : ConvolveSerially(*field, 0.0, options));
  }
  if (state.range(0) == 1) return;
  const Image<float> exact = *ConvolveSerially(*field, 0.0, options);
  double sum = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    sum += std::pow(static_cast<double>(image.data()[i] - exact.data()[i]), 2.0);
  }
  state.counters["rms_levels"] = std::sqrt(sum / static_cast<double>(exact.size()));
}
BENCHMARK(Convolve)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(1);

/// f.8: 5,000 particles with trails of 16 points.
/// Speeds to 1 m/s, cells of 0.5 m.
void DriftParticles(benchmark::State& state) {
  const auto field =
      MakeSteady(Square(257, 64.0), [](const Vec3& p) { return Gyres(p * (1.0 / 64.0)); });
  auto particles =
      Particles::Create(*field, {.count = 5000, .life_s = 10.0, .trail_s = 1.5, .threads = 2});
  Seconds time = 10.0;
  benchmark::DoNotOptimize(particles->At(time));
  for (auto _ : state) {
    time += 1.0 / 30.0;
    benchmark::DoNotOptimize(particles->At(time));
  }
}
BENCHMARK(DriftParticles)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pleinair::content
