// Measures relighting by daylight coefficients: one product for 100,000 vertices.
#include <benchmark/benchmark.h>

#include <vector>

#include "compositor/light/daylight/coefficient_matrix.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

void RelightVertices(benchmark::State& state) {
  const auto vertices = static_cast<std::size_t>(state.range(0));
  const int patches = 146;
  CoefficientMatrix matrix(vertices, patches);
  for (std::size_t i = 0; i < matrix.codes().size(); ++i) {
    matrix.codes()[i] = static_cast<std::uint8_t>(Hash(static_cast<std::uint32_t>(i), 1));
  }
  for (float& scale : matrix.scales()) scale = 1e-4F;
  const std::vector<LinearRgb> sky(patches, {3000, 4000, 6000}), sun(patches, {1, 1, 1});
  std::vector<std::array<float, 3>> light(vertices);
  for (auto _ : state) {
    matrix.Multiply(sky, sun, light);
    benchmark::DoNotOptimize(light.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(RelightVertices)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pleinair::compositor
