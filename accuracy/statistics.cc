#include "accuracy/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "accuracy/distributions.h"
#include "accuracy/normal_quantile.h"
#include "accuracy/random.h"

namespace pleinair::accuracy {
namespace {

/// P(W >= at_least) of Wilcoxon's sum of positive ranks 1…n under symmetry, by counting subsets.
double ExactRankSumGreater(int n, int at_least) {
  std::vector<double> ways(n * (n + 1) / 2 + 1);
  ways[0] = 1.0;
  for (int rank = 1; rank <= n; ++rank) {
    for (int sum = static_cast<int>(ways.size()) - 1; sum >= rank; --sum) {
      ways[sum] += ways[sum - rank];
    }
  }
  double tail = 0.0;
  for (std::size_t sum = std::max(0, at_least); sum < ways.size(); ++sum) tail += ways[sum];
  return tail * std::pow(0.5, n);
}

/// Standard error of the mean of at least two values.
double StandardError(const std::vector<double>& values) {
  const double mean = MeanOf(values), n = static_cast<double>(values.size());
  double sum2 = 0.0;
  for (const double value : values) sum2 += (value - mean) * (value - mean);
  return std::sqrt(sum2 / (n - 1.0) / n);
}

}  // namespace

Interval WilsonInterval(std::int64_t hits, std::int64_t trials, double confidence) {
  if (trials == 0) return {0.0, 1.0};
  const double z = NormalQuantile(0.5 + 0.5 * confidence);
  const double n = static_cast<double>(trials), p = static_cast<double>(hits) / n;
  const double middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  // At the ends the formula gives 0 and 1, except for rounding.
  return {hits == 0 ? 0.0 : middle - half, hits == trials ? 1.0 : middle + half};
}

double Percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[below];
  if (below + 1 == static_cast<std::ptrdiff_t>(values.size())) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  const double part = place - static_cast<double>(below);
  // Between two infinite values there is no value; neither is there a fraction of the way from or
  // to one.
  if (part == 0.0 || low == high || std::isinf(low)) return low;
  return low + part * (high - low);
}

Spread SpreadOf(const std::vector<double>& values) {
  double sum2 = 0.0;
  for (const double value : values) sum2 += value * value;
  return {static_cast<std::int64_t>(values.size()), Percentile(values, 0.5),
          Percentile(values, 0.95), Percentile(values, 0.99),
          std::sqrt(sum2 / static_cast<double>(values.size()))};
}

Interval MeanChiSquareBand(double degrees, std::int64_t count, double confidence) {
  const double n = static_cast<double>(count), tail = 0.5 * (1.0 - confidence);
  return {ChiSquareQuantile(tail, n * degrees) / n, ChiSquareQuantile(1.0 - tail, n * degrees) / n};
}

double McNemarExact(std::int64_t only_first, std::int64_t only_second) {
  const std::int64_t fewer = std::min(only_first, only_second);
  return std::min(1.0, 2.0 * FairCoinCdf(fewer, only_first + only_second));
}

double SignTestGreater(std::int64_t in_favour, std::int64_t against) {
  return FairCoinCdf(against, in_favour + against);
}

double SignedRankGreater(const std::vector<double>& differences) {
  std::vector<double> kept;
  for (const double difference : differences) {
    if (difference != 0.0) kept.push_back(difference);
  }
  if (kept.empty()) return 1.0;
  std::sort(kept.begin(), kept.end(),
            [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  double positive = 0.0, tie_correction = 0.0;
  bool ties = false;
  for (std::size_t i = 0; i < kept.size();) {
    std::size_t end = i;
    while (end < kept.size() && std::fabs(kept[end]) == std::fabs(kept[i])) ++end;
    const double rank = 0.5 * static_cast<double>(i + 1 + end);
    for (std::size_t k = i; k < end; ++k) positive += kept[k] > 0.0 ? rank : 0.0;
    const double tied = static_cast<double>(end - i);
    tie_correction += tied * tied * tied - tied;
    ties = ties || end - i > 1;
    i = end;
  }
  const double n = static_cast<double>(kept.size());
  constexpr std::size_t kMaxExact = 25;
  if (!ties && kept.size() <= kMaxExact) {
    return ExactRankSumGreater(static_cast<int>(kept.size()),
                               static_cast<int>(std::lround(positive)));
  }
  const double mean = n * (n + 1) / 4;
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - tie_correction / 48;
  return 1.0 - NormalCdf((positive - mean - 0.5) / std::sqrt(variance));
}

double MeanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<Interval> MeanInterval(const std::vector<double>& values, double confidence) {
  if (values.size() < 2) return std::nullopt;
  const double degrees = static_cast<double>(values.size()) - 1.0, mean = MeanOf(values);
  const double half = StudentQuantile(0.5 + 0.5 * confidence, degrees) * StandardError(values);
  return Interval{mean - half, mean + half};
}

double MeanGreater(const std::vector<double>& differences, double margin) {
  if (differences.size() < 2) return 1.0;
  const double above = MeanOf(differences) - margin, error = StandardError(differences);
  if (error == 0.0) return above > 0.0 ? 0.0 : 1.0;
  return StudentCdf(-above / error, static_cast<double>(differences.size()) - 1.0);
}

std::vector<bool> HolmRejections(const std::vector<double>& p_values, double alpha) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<bool> rejected(p_values.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (!(p_values[order[i]] <= alpha / static_cast<double>(order.size() - i))) break;
    rejected[order[i]] = true;
  }
  return rejected;
}

Interval BootstrapInterval(std::size_t count,
                           const std::function<double(const std::vector<std::size_t>&)>& statistic,
                           std::string_view purpose, int resamples, double confidence) {
  RandomStream random(0, purpose);
  std::vector<std::size_t> drawn(count);
  std::vector<double> values;
  for (int i = 0; i < resamples && count > 0; ++i) {
    for (std::size_t& index : drawn) {
      index = static_cast<std::size_t>(random.Below(static_cast<int>(count)));
    }
    const double value = statistic(drawn);
    if (!std::isnan(value)) values.push_back(value);
  }
  const double tail = 0.5 * (1.0 - confidence);
  if (values.size() < static_cast<std::size_t>(resamples) / 2) values.clear();
  return {Percentile(values, tail), Percentile(values, 1.0 - tail)};
}

}  // namespace pleinair::accuracy
