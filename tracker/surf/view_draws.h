#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cmath>
#include <cstdint>

namespace pleinair::tracker {

/// Random generator for simulated views (Knuth's multiplier, "MMIX"). The results must not depend
/// on the standard library.
class ViewDraws {
 public:
  /// 31 bits.
  std::uint32_t Next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<std::uint32_t>(state_ >> 33);
  }
  double Uniform() { return Next() / 2147483648.0; }
  /// Approximately normal, standard deviation 1.
  double Normal() { return (Uniform() + Uniform() + Uniform() + Uniform() - 2.0) * std::sqrt(3.0); }

 private:
  std::uint64_t state_ = 20121;
};

}  // namespace pleinair::tracker
