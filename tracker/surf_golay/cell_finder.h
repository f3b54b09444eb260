#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <vector>

#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf_golay/cells/cell_lattice.h"
#include "tracker/surf_golay/image_search.h"

namespace pleinair::tracker {

/// Detects markers with an occluded border by the corners of their cells (CellLattice). Reuses its
/// buffers; one thread at a time.
class CellFinder {
 public:
  /// Both are kept by reference.
  CellFinder(const LensGrid& lens, ImageSearch& image) : image_(image), lattice_(lens) {}

  /// Adds the markers of the search's image; `image_width` in pixels.
  void Find(int image_width);

 private:
  /// Possible position and orientation of a marker's cells.
  struct Placement {
    BlockFitState state;
    double correlation = 0.0;  ///< Correlation of the border.
  };

  ImageSearch& image_;
  CellLattice lattice_;
  std::vector<LatticeGuess> lattices_;
  std::vector<Placement> placements_;
};

}  // namespace pleinair::tracker
