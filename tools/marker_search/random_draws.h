#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace pleinair::marker_search {

/// Random numbers that are the same on every machine. The standard specifies this engine, but not
/// the distributions.
class RandomDraws {
 public:
  explicit RandomDraws(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t Next() { return engine_(); }
  int Below(int limit) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(limit)); }
  /// Uniform in [0, 1).
  double Uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  /// Standard normal (Box & Muller).
  double Normal() {
    return std::sqrt(-2.0 * std::log(1.0 - Uniform())) *
           std::cos(2.0 * std::numbers::pi * Uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pleinair::marker_search
