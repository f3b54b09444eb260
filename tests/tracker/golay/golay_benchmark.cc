#include <benchmark/benchmark.h>

#include <array>
#include <numeric>
#include <random>
#include <vector>

#include "tracker/golay/golay_scores.h"
#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {
namespace {

std::vector<CellLikelihoods> RandomCells() {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0.0F, 3.0F);
  std::vector<CellLikelihoods> all(256);
  for (auto& cells : all) {
    for (float& cell : cells) cell = normal(random);
  }
  return all;
}

/// With the first N numbers in use; 0: all.
void SoftDecode(benchmark::State& state) {
  const auto cells = RandomCells();
  SoftGolayDecoder decoder;
  std::vector<int> numbers(static_cast<std::size_t>(state.range(0)));
  std::iota(numbers.begin(), numbers.end(), 0);
  if (!decoder.SetNumbersInUse(numbers)) state.SkipWithError("numbers out of range");
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(decoder.Decode(cells[++i % cells.size()]));
}
BENCHMARK(SoftDecode)->Arg(0)->Arg(50)->Arg(4095);

void ScoreAllWords(benchmark::State& state) {
  std::array<std::int32_t, kGolayBits> weights;
  std::iota(weights.begin(), weights.end(), -11);
  GolayScores scores;
  for (auto _ : state) {
    ScoreGolayWords(weights, scores);
    benchmark::DoNotOptimize(scores);
  }
}
BENCHMARK(ScoreAllWords);

}  // namespace
}  // namespace pleinair::tracker

BENCHMARK_MAIN();
