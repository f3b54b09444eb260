// Time of a leaf's spectrum and of its colors.
#include <benchmark/benchmark.h>

#include <vector>

#include "compositor/leaf/leaf_color.h"
#include "compositor/leaf/prospect.h"

namespace pleinair::compositor {
namespace {

constexpr scene::LeafContents kGreen{30.0, 10.0, 1.0, 0.0, 0.015, 0.009, 1.2};

void SpectrumOfLeaf(benchmark::State& state) {
  std::vector<LeafOptics> spectrum(kLeafBands);
  for (auto _ : state) {
    ProspectSpectrum(kGreen, kFirstLeafNm, spectrum);
    benchmark::DoNotOptimize(spectrum.data());
  }
}
BENCHMARK(SpectrumOfLeaf)->Unit(benchmark::kMicrosecond);

void ColorsOfOneLeaf(benchmark::State& state) {
  const scene::Leaf leaf{.contents = kGreen};
  for (auto _ : state) benchmark::DoNotOptimize(ColorsOfLeaf(leaf, LeafIlluminant::D65()));
}
BENCHMARK(ColorsOfOneLeaf)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace pleinair::compositor
