#include "tracker/golay/golay_code.h"

#include <array>
#include <bit>

#include "base/check.h"

namespace pleinair::tracker {
namespace {

constexpr int kHalf = 12;
constexpr std::uint32_t kHalfMask = (1U << kHalf) - 1;

// Rows of B; B is symmetric and its own inverse over GF(2), which the decoder relies on.
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

/// The error of weight 3 or less that has the syndrome, if there is one.
std::optional<GolayWord> FindError(std::uint32_t syndrome) {
  // With r = (u, p), the syndrome s = u B + p equals e_u B + e_p. At most one wrong bit lies in one
  // of the halves; that half is guessed, and the other then follows.
  if (std::popcount(syndrome) <= 3) return Join(0, syndrome);
  for (int i = 0; i < kHalf; ++i) {
    const std::uint32_t parity_errors = syndrome ^ kParityRows[i];
    if (std::popcount(parity_errors) <= 2) return Join(1U << i, parity_errors);
  }
  const std::uint32_t syndrome_b = TimesB(syndrome);  // e_u + e_p B, because B B = I.
  if (std::popcount(syndrome_b) <= 3) return Join(syndrome_b, 0);
  for (int i = 0; i < kHalf; ++i) {
    const std::uint32_t number_errors = syndrome_b ^ kParityRows[i];
    if (std::popcount(number_errors) <= 2) return Join(number_errors, 1U << i);
  }
  return std::nullopt;
}

}  // namespace

GolayWord EncodeGolay(int number) {
  CHECK_GE(number, 0);
  CHECK_LT(number, kGolayNumbers);
  const auto half = static_cast<std::uint32_t>(number);
  return Join(half, TimesB(half));
}

GolayWord CodewordOfNumber(int number) { return EncodeGolay(number) ^ kGolayWhitening; }

std::optional<HardGolayDecoding> DecodeGolay(GolayWord word) {
  const std::uint32_t number = word & kHalfMask;
  const std::uint32_t parity = (word >> kHalf) & kHalfMask;
  const std::optional<GolayWord> error = FindError(TimesB(number) ^ parity);
  if (!error) return std::nullopt;
  return HardGolayDecoding{static_cast<int>((number ^ *error) & kHalfMask), std::popcount(*error)};
}

std::optional<HardGolayDecoding> DecodeCodeword(GolayWord cells) {
  return DecodeGolay(cells ^ kGolayWhitening);
}

}  // namespace pleinair::tracker
