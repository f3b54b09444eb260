#pragma once

#include <cstdint>
#include <optional>

namespace pleinair::tracker {

/// A word of 24 bits in the low bits of an integer.
using GolayWord = std::uint32_t;

constexpr int kGolayBits = 24;
constexpr int kGolayNumbers = 4096;

/// XORed onto a codeword before it is printed. Bit i is the i-th cell of the marker, row by row
/// from the top-left without the centre cell; the mask is the chequerboard whose corners are white.
/// It lies 4 bits from the nearest codeword, which is as far as any word can lie (the code's
/// covering radius is 4: MacWilliams & Sloane 1977, ch. 2, §6). The all-black and the all-white
/// word are codewords, so every printed word has at least 4 white and at least 4 black cells, and a
/// blank patch is never the marker of a number.
constexpr GolayWord kGolayWhitening = 0xAAA555;

/// The word of the extended binary Golay code (24,12,8) for a number in 0…4095; CHECKs the range.
/// Systematic: bits 0…11 are the number's own, bit 12 + j is the parity of number & row j of the
/// symmetric matrix B in the generator [I | B]: the bordered circulant of the quadratic residues
/// modulo 11 (Morelos-Zaragoza, The Art of Error Correcting Coding, 2nd ed. 2006, §2.2.3, with bits
/// numbered from the other end).
GolayWord EncodeGolay(int number);

/// The 24 cells as they are printed, 1 = white: EncodeGolay(number) ^ kGolayWhitening.
GolayWord CodewordOfNumber(int number);

/// What a hard decoder made of a word.
struct HardGolayDecoding {
  int number = 0;
  int corrected_bits = 0;  ///< 0…3.
};

/// The only codeword within 3 bits of `word`, by arithmetic decoding (Morelos-Zaragoza 2006,
/// §2.2.3); none where four or more bits are wrong and no codeword is near. Bits above the 24th are
/// ignored. Four wrong bits never give a number, five or more may give a wrong one: the spheres of
/// radius 3 hold 2325/4096 = 57 % of all words, so that a number alone proves little. Decide by the
/// margin of SoftGolayDecoder where the cells' likelihoods are known.
std::optional<HardGolayDecoding> DecodeGolay(GolayWord word);

/// The same for 24 printed cells.
std::optional<HardGolayDecoding> DecodeCodeword(GolayWord cells);

}  // namespace pleinair::tracker
