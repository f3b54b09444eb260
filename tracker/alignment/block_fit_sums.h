#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/block_sums.h"

namespace pleinair::tracker {

struct BlockFit::Sums {
  BlockSums blocks;
  std::vector<RowRange> ranges;
  std::vector<BlockLight> lights;
  std::vector<LevelSums> levels;
  std::vector<BlockMotions> motions;
  FitProducts products;
  LightSlope slope;
  SlopeEquations slopes;
};

}  // namespace pleinair::tracker
