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

/// Confidence of all intervals here unless said otherwise.
inline constexpr double kConfidence = 0.95;

/// Of the probability behind `hits` of `trials`. Wilson 1927, "Probable inference, the law of
/// succession, and statistical inference", Eq. (6); no trials: 0…1.
Interval WilsonInterval(std::int64_t hits, std::int64_t trials, double confidence = kConfidence);

/// Between the two nearest of the sorted values, linearly (Hyndman & Fan 1996, definition 7); not a
/// number where there is none.
double Percentile(std::vector<double> values, double share);

/// Median, 95th and 99th percentile, root mean square.
struct Spread {
  std::int64_t count = 0;
  double median = 0.0, p95 = 0.0, p99 = 0.0, rms = 0.0;
};
Spread SpreadOf(const std::vector<double>& values);

/// Where the mean of `count` values of a χ² with `degrees` of freedom lies with 95 %. Bar-Shalom,
/// Li & Kirubarajan 2001, section 5.4.2.
Interval MeanChiSquareBand(double degrees, std::int64_t count, double confidence = kConfidence);

/// Exact test of two detectors on the same markers, by the markers that one found and the other did
/// not: two-sided p that both are equally good. McNemar 1947, with the binomial distribution.
double McNemarExact(std::int64_t only_first, std::int64_t only_second);
/// One-sided: p that the second is no better, given how often each alone was right.
double SignTestGreater(std::int64_t in_favour, std::int64_t against);

/// p of the hypothesis that paired differences lie about 0, against that they lie above. Wilcoxon
/// 1945, "Individual comparisons by ranking methods"; zeros are left out, ties share ranks; exact
/// for up to 25 differences without ties, the normal approximation with continuity correction
/// beyond.
double SignedRankGreater(const std::vector<double>& differences);

/// Mean of a few values with the interval that holds the mean behind them, if they are about
/// normal: Student 1908, "The probable error of a mean". Nothing for less than two.
std::optional<Interval> MeanInterval(const std::vector<double>& values,
                                     double confidence = kConfidence);
double MeanOf(const std::vector<double>& values);

/// p of the hypothesis that the mean behind paired differences is at most `margin` (Student's
/// paired test); 1 for less than two.
double MeanGreater(const std::vector<double>& differences, double margin);

/// Smallest p first, each multiplied by how many remain: which hypotheses fall at level `alpha` of
/// being wrong about any of them. Holm 1979, "A simple sequentially rejective multiple test
/// procedure".
std::vector<bool> HolmRejections(const std::vector<double>& p_values, double alpha);

/// Percentile interval of a statistic of `count` samples: it is computed from `resamples` drawings
/// of indices with replacement. Efron & Tibshirani 1993, "An Introduction to the Bootstrap",
/// section 13.3. `purpose` names the random numbers: the same data give the same interval. Drawings
/// whose statistic is no number (0/0) are no samples of it and left out; where most are so, the
/// ends are no numbers. Where it is infinite in many (1/0), an end is infinite.
Interval BootstrapInterval(std::size_t count,
                           const std::function<double(const std::vector<std::size_t>&)>& statistic,
                           std::string_view purpose, int resamples = 1000,
                           double confidence = kConfidence);

}  // namespace pleinair::accuracy
