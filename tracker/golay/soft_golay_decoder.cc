#include "tracker/golay/soft_golay_decoder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "tracker/golay/golay_scores.h"

namespace pleinair::tracker {
namespace {

// 24 · 1000 · 2¹⁶ < 2³¹: no sum of weights overflows.
constexpr float kMaxLikelihood = 1000.0F;
constexpr float kUnitsPerLikelihood = 65536.0F;

std::int32_t Quantize(float likelihood) {
  if (std::isnan(likelihood)) return 0;
  return static_cast<std::int32_t>(
      std::lrint(std::clamp(likelihood, -kMaxLikelihood, kMaxLikelihood) * kUnitsPerLikelihood));
}

float FromUnits(std::int64_t units) { return static_cast<float>(units) / kUnitsPerLikelihood; }

struct Candidates {
  int number = 0;
  std::optional<int> second;
};

Candidates FindAmongAll(const GolayScores& scores, const TopTwoScores& top) {
  const auto begin = scores.begin(), end = scores.end();
  const auto best = std::find(begin, end, top.best);
  auto second = std::find(begin, end, top.second);
  if (second == best) second = std::find(best + 1, end, top.second);
  return {static_cast<int>(best - begin), static_cast<int>(second - begin)};
}

Candidates FindAmong(const std::vector<std::uint16_t>& numbers, const GolayScores& scores) {
  // Values first, in a branch-free loop because scores are random; then their positions.
  TopTwoScores top{scores[numbers.front()], std::numeric_limits<std::int32_t>::min()};
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const std::int32_t score = scores[numbers[i]];
    top.second = std::max(top.second, std::min(top.best, score));
    top.best = std::max(top.best, score);
  }
  const auto find = [&](std::size_t from, std::int32_t score) {
    while (scores[numbers[from]] != score) ++from;
    return from;
  };
  const std::size_t best = find(0, top.best);
  Candidates found{numbers[best], std::nullopt};
  if (numbers.size() > 1) {
    std::size_t second = find(0, top.second);
    if (second == best) second = find(best + 1, top.second);
    found.second = numbers[second];
  }
  return found;
}

}  // namespace

Result<void> SoftGolayDecoder::SetNumbersInUse(std::span<const int> numbers) {
  for (const int number : numbers) {
    if (number < 0 || number >= kGolayNumbers) {
      return InputError("", "there is no marker number " + std::to_string(number),
                        "use numbers from 0 to " + std::to_string(kGolayNumbers - 1));
    }
  }
  numbers_in_use_.assign(numbers.begin(), numbers.end());
  std::sort(numbers_in_use_.begin(), numbers_in_use_.end());
  numbers_in_use_.erase(std::unique(numbers_in_use_.begin(), numbers_in_use_.end()),
                        numbers_in_use_.end());
  return {};
}

int SoftGolayDecoder::NumbersInUse() const {
  return numbers_in_use_.empty() ? kGolayNumbers : static_cast<int>(numbers_in_use_.size());
}

std::optional<int> SoftGolayDecoder::NumberOfCells(GolayWord cells) const {
  const auto number = static_cast<int>((cells ^ kGolayWhitening) & (kGolayNumbers - 1));
  const bool in_use =
      numbers_in_use_.empty() || std::ranges::binary_search(numbers_in_use_, number);
  return in_use && CodewordOfNumber(number) == cells ? std::optional(number) : std::nullopt;
}

SoftGolayDecoding SoftGolayDecoder::Decode(const CellLikelihoods& cells) const {
  SoftGolayDecoding decoding;
  std::array<std::int32_t, kGolayBits>
      weights;  // Weights of the codeword's bits, before whitening.
  std::int64_t evidence = 0;
  for (int i = 0; i < kGolayBits; ++i) {
    const std::int32_t weight = Quantize(cells[i]);
    weights[i] = (kGolayWhitening >> i & 1U) != 0 ? -weight : weight;
    evidence += std::abs(weight);
    decoding.erasures += weight == 0 ? 1 : 0;
  }
  GolayScores scores;
  ScoreGolayWords(weights, scores);
  const TopTwoScores top = FindTopTwo(scores);
  const Candidates found =
      numbers_in_use_.empty() ? FindAmongAll(scores, top) : FindAmong(numbers_in_use_, scores);
  const std::int64_t best = scores[found.number];
  decoding.number = found.number;
  decoding.score = FromUnits(best);
  decoding.second_number = found.second;
  decoding.margin = found.second ? FromUnits(best - scores[*found.second])
                                 : std::numeric_limits<float>::infinity();
  decoding.shortfall = FromUnits(top.best - best);
  if (evidence != 0) {
    decoding.agreement = static_cast<float>(best) / static_cast<float>(evidence);
  }
  const GolayWord word = EncodeGolay(found.number);
  for (int i = 0; i < kGolayBits; ++i) {
    const bool bit = (word >> i & 1U) != 0;
    if (weights[i] != 0 && (weights[i] > 0) != bit) ++decoding.disagreements;
  }
  return decoding;
}

}  // namespace pleinair::tracker
