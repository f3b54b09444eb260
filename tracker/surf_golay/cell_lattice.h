#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf_golay/corner_points.h"

namespace pleinair::tracker {

/// A place where the cells of a marker may be, by the corners between black and white cells.
struct LatticeGuess {
  /// Any of the four ways round: the corners of cells look the same from all sides.
  Mat3 modules_from_undistorted;
  double score =
      0.0;  ///< Corners of cells that are there, less corners inside that are of no cell.
};

/// Finds the 5×5 cells of markers whose border is covered, whatever their number: edges that meet
/// at a corner give a lattice's two directions and, up to small whole numbers, its two steps; where
/// the corners around lie on the lattice, and few beside it, there may be cells. The lattice is
/// then fitted to all its corners as a homography.
class CellLattice {
 public:
  explicit CellLattice(const LensGrid& lens) : lens_(lens) {}

  /// Best first, few. `scale`: size of a pixel of `grey`, a reduced image, in the image's own.
  void Find(ImageView<const std::uint8_t> grey, double scale, std::vector<LatticeGuess>* guesses);

 private:
  static constexpr int kNodes = 6;           ///< Corners of cells along a side of the content.
  static constexpr int kReach = kNodes - 1;  ///< Steps to the farthest node from any other.
  static constexpr int kAround = 2 * kReach + 1;

  /// A corner's neighbour at the other end of an edge.
  struct Arm {
    Vec2 to;
    float squared_length;
  };
  /// Cells' corners at corner + u·along + v·down, u and v from `first_u`, `first_v` on.
  struct Lattice {
    Vec2 corner, along, down;
    int first_u = 0, first_v = 0;
    double score = 0.0;
  };
  void SortIntoTiles();
  void FindArms(ImageView<const std::uint8_t> grey, const CornerPoint& corner);
  /// How much the image's edges between two corners run from one to the other: 0…1.
  static double EdgeShare(ImageView<const std::uint8_t> grey, Vec2 from, Vec2 to);
  void MapCorners(int width, int height);
  bool CornerAt(Vec2 at, double within_px) const;
  /// Whether enough of the nodes around the corner are corners; costs a tenth of a count.
  bool Promising(const Lattice& lattice) const;
  void Score(Lattice* lattice) const;
  void Keep(const Lattice& lattice);
  bool Fit(const Lattice& lattice, double scale, LatticeGuess* guess) const;
  template <typename Visit>
  void ForCornersAround(Vec2 middle, double reach_px, Visit visit) const;

  const LensGrid& lens_;
  CornerPoints detector_;
  std::vector<CornerPoint> corners_;
  int tile_columns_ = 0, tile_rows_ = 0;
  std::vector<int> tile_begin_;  ///< Index of the first corner of each tile, and one more.
  int map_width_ = 0, map_height_ = 0;
  std::vector<std::int16_t> nearest_;  ///< A pixel's nearest corner within a few pixels, or -1.
  std::vector<Arm> arms_;
  std::vector<Lattice> best_;
};

}  // namespace pleinair::tracker
