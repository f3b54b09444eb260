#pragma once

#include <cstdint>

#include "tracker/print_pattern.h"

namespace pleinair::tracker {

/// What the print of an S-G marker looks like, quiet zone included. `number` is 0…4095.
PrintPattern SgPrint(int number);

/// The same for a printed word: bit i (from the least significant) is code cell i, 1 white.
PrintPattern SgPrintOfWord(std::uint32_t word);

}  // namespace pleinair::tracker
