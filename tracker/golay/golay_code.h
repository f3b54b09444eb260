#pragma once

#include <cstdint>

namespace pleinair::tracker {

/// A 24-bit word in the low bits of an integer.
using GolayWord = std::uint32_t;

constexpr int kGolayBits = 24;
constexpr int kGolayNumbers = 4096;

/// XORed onto a codeword before it is printed. Bit i is the i-th cell of the marker, row by row
/// from the top-left without the centre cell. The mask is the chequerboard with white corners.
/// The mask's distance to the nearest codeword is 4, the maximum for any word: the code's covering
/// radius is 4 (MacWilliams & Sloane 1977, ch. 2, §6). The all-black and the all-white word are
/// codewords. So every printed word has at least 4 white and at least 4 black cells, and a uniform
/// patch never decodes to a number.
constexpr GolayWord kGolayWhitening = 0xAAA555;

/// Codeword of the extended binary Golay code (24,12,8) for a number in 0…4095; CHECKs the range.
/// The code is systematic. Bits 0…11 are the number; bit 12 + j is the parity of number & row j of
/// the symmetric matrix B in the generator [I | B]. B is the bordered circulant of the quadratic
/// residues modulo 11. Source: Morelos-Zaragoza, The Art of Error Correcting Coding, 2nd ed. 2006,
/// §2.2.3, with bits numbered from the other end.
GolayWord EncodeGolay(int number);

/// The 24 printed cells, 1 = white: EncodeGolay(number) ^ kGolayWhitening.
GolayWord CodewordOfNumber(int number);

}  // namespace pleinair::tracker
