#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace pleinair {

/// Milliseconds per run of each processing stage, in the order in which the stages first ran.
class StageTimes {
 public:
  struct Summary {
    std::string stage;
    std::size_t runs = 0;
    double median_ms = 0.0;
    double p95_ms = 0.0;
    double total_ms = 0.0;
  };

  void Add(const std::string& stage, double milliseconds) {
    for (auto& [name, samples] : stages_) {
      if (name == stage) {
        samples.push_back(static_cast<float>(milliseconds));
        return;
      }
    }
    stages_.emplace_back(stage, std::vector<float>{static_cast<float>(milliseconds)});
  }

  /// Runs `work` and adds its duration to the samples of `stage`.
  template <typename Work>
  auto Measure(const std::string& stage, Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    Add(stage, taken.count());
    return result;
  }

  /// Adds the samples that another thread measured.
  void Add(const StageTimes& other) {
    for (const auto& [name, samples] : other.stages_) {
      for (const float sample : samples) Add(name, sample);
    }
  }

  std::vector<Summary> Summarize() const {
    std::vector<Summary> summaries;
    for (const auto& [name, samples] : stages_) {
      summaries.push_back({name, samples.size(), Quantile(samples, 0.5), Quantile(samples, 0.95),
                           std::accumulate(samples.begin(), samples.end(), 0.0)});
    }
    return summaries;
  }

  /// Quantile by nearest rank: the smallest sample that is at least as large as the share `q` (0…1)
  /// of all samples. 0 without samples.
  template <typename T>
  static double Quantile(std::vector<T> samples, double q) {
    if (samples.empty()) return 0.0;
    const double rank = std::ceil(q * static_cast<double>(samples.size())) - 1.0;
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 0.0));
    std::nth_element(samples.begin(), at, samples.end());
    return static_cast<double>(*at);
  }

 private:
  std::vector<std::pair<std::string, std::vector<float>>> stages_;
};

}  // namespace pleinair
