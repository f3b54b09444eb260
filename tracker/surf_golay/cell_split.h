#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>

#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/surf_golay/cell_reader.h"

namespace pleinair::tracker {

/// Where the cells of a marker may part into black and white ones by themselves, whatever the
/// border says about the light: the likelihoods of at most so many ways, the clearest first.
struct CellSplits {
  static constexpr int kMax = 2;
  std::array<CellLikelihoods, kMax> likelihoods{};
  int count = 0;
};

/// Looks for gaps between the cells' shares of white, on a scale of ratios: light that differs over
/// the marker, or that the covered border tells wrongly, changes what a white cell looks like by
/// any factor, but leaves the black ones near black. Every marker has at least four cells of each
/// color (kGolayWhitening), so no gap nearer to either end is one between the colors.
CellSplits SplitCells(const CellReading& cells);

}  // namespace pleinair::tracker
