#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace pleinair::accuracy {

struct Interval {
  double low = 0.0, high = 0.0;
  bool Contains(double value) const { return value >= low && value <= high; }
};

/// Confidence of all intervals unless documented otherwise.
inline constexpr double kConfidence = 0.95;

/// Confidence interval of a probability from `hits` of `trials`. Wilson 1927, "Probable inference,
/// the law of succession, and statistical inference", Eq. (6); without trials 0…1.
Interval WilsonInterval(std::int64_t hits, std::int64_t trials, double confidence = kConfidence);

/// Quantile by linear interpolation between the two nearest sorted values (Hyndman & Fan 1996,
/// definition 7); NaN without values.
double Percentile(std::vector<double> values, double share);

/// Median, 95th and 99th percentile, root mean square.
struct Spread {
  std::int64_t count = 0;
  double median = 0.0, p95 = 0.0, p99 = 0.0, rms = 0.0;
};
Spread SpreadOf(const std::vector<double>& values);

/// Central interval of the mean of `count` values of a χ² with `degrees` of freedom. Bar-Shalom, Li
/// & Kirubarajan 2001, section 5.4.2.
Interval MeanChiSquareBand(double degrees, std::int64_t count, double confidence = kConfidence);

/// Exact test of two detectors on the same markers, from the numbers of markers that only one of
/// them found: two-sided p that both are equally good. McNemar 1947, with the binomial
/// distribution.
double McNemarExact(std::int64_t only_first, std::int64_t only_second);
/// One-sided p that the second is no better, from the numbers of cases in which only one was right.
double SignTestGreater(std::int64_t in_favour, std::int64_t against);

/// p of the hypothesis that paired differences are centred at 0, against that they are above.
/// Wilcoxon 1945, "Individual comparisons by ranking methods". Zeros are left out, ties share
/// ranks. Exact for up to 25 differences without ties; beyond, the normal approximation with
/// continuity correction.
double SignedRankGreater(const std::vector<double>& differences);

/// Mean of a few approximately normal values with the confidence interval of their expectation:
/// Student 1908, "The probable error of a mean". Nullopt for fewer than two.
std::optional<Interval> MeanInterval(const std::vector<double>& values,
                                     double confidence = kConfidence);
double MeanOf(const std::vector<double>& values);

/// p of the hypothesis that the expectation of paired differences is at most `margin` (Student's
/// paired test); 1 for fewer than two.
double MeanGreater(const std::vector<double>& differences, double margin);

/// Hypotheses rejected with the probability `alpha` of any false rejection: p-values in ascending
/// order, each multiplied by the number of remaining ones. Holm 1979, "A simple sequentially
/// rejective multiple test procedure".
std::vector<bool> HolmRejections(const std::vector<double>& p_values, double alpha);

/// Percentile bootstrap interval of a statistic of `count` samples, computed from `resamples` draws
/// of indices with replacement. Efron & Tibshirani 1993, "An Introduction to the Bootstrap",
/// section 13.3. `purpose` names the random stream: the same data give the same interval. Draws
/// whose statistic is NaN (0/0) are left out; if most are, the ends are NaN. If the statistic is
/// infinite in many draws (1/0), an end is infinite.
Interval BootstrapInterval(std::size_t count,
                           const std::function<double(const std::vector<std::size_t>&)>& statistic,
                           std::string_view purpose, int resamples = 1000,
                           double confidence = kConfidence);

}  // namespace pleinair::accuracy
