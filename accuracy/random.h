#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace pleinair::accuracy {

/// Philox4x32-10: four 32-bit words as a function of a counter and a key, so that any frame of a
/// sweep can be generated alone and on any machine. Salmon, Moraes, Dror & Shaw 2011, "Parallel
/// random numbers: as easy as 1, 2, 3", section 3.3.
std::array<std::uint32_t, 4> Philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// Random numbers for one purpose. They depend on the seed and the purpose's name alone, not on
/// other streams or on the compiler: the standard library's distributions are not used.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose);

  std::uint32_t Word();
  double Uniform();                         ///< In [0, 1), 53 bits.
  double Uniform(double low, double high);  ///< In [low, high).
  int Below(int count);                     ///< 0…count-1; count > 0.
  /// Standard normal, by the inverse distribution function.
  double Normal();
  /// As Normal(), from a single word, thus never beyond ±6.3: for the noise of millions of pixels.
  float NormalFromWord();

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
};

}  // namespace pleinair::accuracy
