#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>

#include "tracker/golay/soft_golay_decoder.h"
#include "tracker/surf_golay/cells/cell_reader.h"

namespace pleinair::tracker {

/// Ways to divide the cells into black and white ones without the light estimated from the border:
/// the likelihoods of a few ways, the clearest first.
struct CellSplits {
  static constexpr int kMax = 2;
  std::array<CellLikelihoods, kMax> likelihoods{};
  int count = 0;
};

/// Searches for gaps between the cells' shares of white, on a logarithmic scale. Light that varies
/// over the marker, or that is estimated wrongly from an occluded border, scales white cells by any
/// factor but leaves black ones near black. Every marker has at least four cells of each color
/// (kGolayWhitening), so gaps nearer to either end are excluded.
CellSplits SplitCells(const CellReading& cells);

}  // namespace pleinair::tracker
