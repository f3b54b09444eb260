#include "tracker/surf_golay/cell_finder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

/// Maximum width of the image in which the corners of cells are searched for.
constexpr int kMaxLatticeWidth_px = 900;
/// Minimum correlation with a mostly occluded border; maximum number of placements that are
/// decoded.
constexpr double kCoveredCorrelation = 0.1;
constexpr std::size_t kMaxPlacements = 6;
}  // namespace

void CellFinder::Find(int image_width) {
  int level = 0;
  while (image_width >> level > kMaxLatticeWidth_px && level + 1 < ReducedImages::kLevels) {
    ++level;
  }
  lattice_.Find(image_.upright.reduced().Level(level), 1 << level, &lattices_);
  placements_.clear();
  for (const LatticeGuess& guess : lattices_) {
    // A row of cells without a corner may be at either end: try one cell to each side too.
    for (int shift = 0; shift < 9; ++shift) {
      Mat3 by;
      const int column = shift % 3 - 1, row = shift / 3 - 1;
      by(0, 2) = sg::kCell * column;
      by(1, 2) = sg::kCell * row;
      const std::array<Vec2, 4> undistorted =
          UndistortedSquareCorners(by * guess.modules_from_undistorted);
      if (image_.found.IsTaken(by * guess.modules_from_undistorted)) continue;
      for (const BorderOrientation& orientation :
           image_.upright.Orientations(by * guess.modules_from_undistorted)) {
        if (orientation.mirrored || orientation.correlation < kCoveredCorrelation) continue;
        std::array<Vec2, 4> turned;
        for (int k = 0; k < 4; ++k) turned[k] = undistorted[(orientation.first_corner + k) % 4];
        Placement placement;
        placement.state.modules_from_undistorted = ModulesFromSquareCorners(turned);
        placement.correlation = orientation.correlation;
        placements_.push_back(placement);
      }
    }
  }
  std::ranges::stable_sort(placements_, std::ranges::greater{}, &Placement::correlation);
  if (placements_.size() > kMaxPlacements) placements_.resize(kMaxPlacements);
  for (const Placement& placement : placements_) {
    if (image_.found.IsTaken(placement.state.modules_from_undistorted)) continue;
    const std::optional<SgReading> reading = image_.DecodeAsGuessed(placement.state);
    if (reading && image_.upright.IsUpright(*reading))
      image_.Add(*reading, DetectionPath::kSurfGolay);
  }
}

}  // namespace pleinair::tracker
