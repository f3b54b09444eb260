#include "tracker/golay/golay_code.h"

#include <array>
#include <bit>

#include "base/check.h"

namespace pleinair::tracker {
namespace {

constexpr int kHalf = 12;
constexpr std::uint32_t kHalfMask = (1U << kHalf) - 1;

// Rows of B, which is symmetric.
constexpr std::array<std::uint32_t, kHalf> kParityRows = {0xA3B, 0xD1D, 0xE8E, 0xB47, 0xDA3, 0xED1,
                                                          0xF68, 0xBB4, 0x9DA, 0x8ED, 0xC76, 0x7FF};

/// half · B.
std::uint32_t TimesB(std::uint32_t half) {
  std::uint32_t product = 0;
  for (int j = 0; j < kHalf; ++j) {
    product |= (std::popcount(half & kParityRows[j]) & 1U) << j;
  }
  return product;
}

GolayWord Join(std::uint32_t number_half, std::uint32_t parity_half) {
  return number_half | parity_half << kHalf;
}

}  // namespace

GolayWord EncodeGolay(int number) {
  CHECK_GE(number, 0);
  CHECK_LT(number, kGolayNumbers);
  const auto half = static_cast<std::uint32_t>(number);
  return Join(half, TimesB(half));
}

GolayWord CodewordOfNumber(int number) { return EncodeGolay(number) ^ kGolayWhitening; }

}  // namespace pleinair::tracker
