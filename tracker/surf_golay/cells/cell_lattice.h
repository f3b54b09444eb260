#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf_golay/cells/corner_points.h"

namespace pleinair::tracker {

/// Hypothesis of the position of a marker's cells, from the corners between black and white cells.
struct LatticeGuess {
  /// In any of the four orientations, which the corners do not distinguish.
  Mat3 modules_from_undistorted;
  double score =
      0.0;  ///< Number of detected cell corners, minus corners inside that do not belong to a cell.
};

/// Finds the 5×5 cells of markers with an occluded border, independent of their number. Edges that
/// meet at a corner give a lattice's two directions and, up to small integers, its two steps. A
/// lattice is a hypothesis if most corners nearby lie on it and few beside it. A homography is then
/// fitted to all its corners.
class CellLattice {
 public:
  explicit CellLattice(const LensGrid& lens) : lens_(lens) {}

  /// The few best, best first. `scale`: pixel size of `grey`, a reduced image, in full-image
  /// pixels.
  void Find(ImageView<const std::uint8_t> grey, double scale, std::vector<LatticeGuess>* guesses);

 private:
  static constexpr int kNodes = 6;           ///< Cell corners along a side of the content.
  static constexpr int kReach = kNodes - 1;  ///< Maximum distance of two nodes, in steps.
  static constexpr int kAround = 2 * kReach + 1;

  /// The neighbour of a corner at the other end of an edge.
  struct Arm {
    Vec2 to;
    float squared_length;
  };
  /// Cell corners at corner + u·along + v·down, u from `first_u`, v from `first_v`.
  struct Lattice {
    Vec2 corner, along, down;
    int first_u = 0, first_v = 0;
    double score = 0.0;
  };
  void SortIntoTiles();
  void FindArms(ImageView<const std::uint8_t> grey, const CornerPoint& corner);
  /// Strength of the image edge between two corners, along the line from one to the other: 0…1.
  static double EdgeShare(ImageView<const std::uint8_t> grey, Vec2 from, Vec2 to);
  void MapCorners(int width, int height);
  bool CornerAt(Vec2 at, double within_px) const;
  /// Whether enough of the nodes around the corner are corners; a tenth of the cost of a full
  /// count.
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
  std::vector<int> tile_begin_;  ///< Index of the first corner of each tile, plus the end.
  int map_width_ = 0, map_height_ = 0;
  std::vector<std::int16_t> nearest_;  ///< Nearest corner of each pixel within a few pixels, or -1.
  std::vector<Arm> arms_;
  std::vector<Lattice> best_;
};

}  // namespace pleinair::tracker
