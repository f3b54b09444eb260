#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/alignment/tile_kernels.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Sums over a block's pixels that determine its gain and offset: see kLevelSums.
struct LevelSums {
  double pixels, w, wp, wi, wpp, wpi, wii, r, rp, ri, rpp, rpi;
};

/// Gain, offset and robust weight of a block.
struct BlockLight {
  float gain = 0.0F, offset = 0.0F;
  float inverse = 0.0F;  ///< 1 / (gain × robust share); 0: light unknown, all residuals count
                         ///< fully.
  float robust_weight = 0.0F;
};

/// The part of a block's derivatives, per parameter, that a change of its gain (`on_white`) and
/// offset (`on_one`) can reproduce.
struct BlockElimination {
  bool possible = false;
  std::array<double, kFitParameters> on_white{}, on_one{};
};

/// The equations of a fit, split by position on the marker into a grid of cells that is independent
/// of the blocks.
struct CellScores {
  static constexpr int kAlong = 8;
  std::array<std::array<double, kFitParameters>, kAlong * kAlong> gradient{};  ///< Σ gain w r J,
  std::array<int, kAlong * kAlong> tiles{};  ///< … and the number of tiles.
};

/// The gradient of the light over the marker as two more parameters of a fit, with the blocks'
/// light eliminated. φ_u = u' (gain p + offset), and φ_v likewise; u' and v' are half edges from
/// the centre of each block. Inner products with the final weights.
struct SlopeEquations {
  std::array<std::array<double, 2>, 2> own{};                ///< φ with φ,
  std::array<std::array<double, kFitParameters>, 2> with{};  ///< … with gain J,
  std::array<double, 2> right{};                             ///< … and with the residuals.
  bool known = false;  ///< The equations determine the gradient.
};

/// Change of the logarithm of light per half edge, to the right and downwards, within each block.
struct LightSlope {
  double by_u = 0.0, by_v = 0.0;
};

/// Sums over the pixels of each block of a marker. Pixels are first summed in tiles of 2×2 or 4×4,
/// which belong to the block that contains their centre. Position on the marker and derivatives of
/// the map are constant in a tile, so that only the image slopes are summed per pixel.
class BlockSums {
 public:
  BlockSums();
  /// With given kernels, for tests.
  explicit BlockSums(const TileKernels& kernels) : kernels_(&kernels) {}

  /// Divides the window into tiles and determines the usable pixels. `ranges` as from
  /// MarkerRaster::RenderMarkerOnly().
  void Lay(const MarkerPattern& pattern, const KnownPart& known, const ObservedPatch& observed,
           const PlaneMap& map, const std::vector<RowRange>& ranges, int tile, int blocks_along,
           const LightSlope& slope = {});

  /// Sums for each block; `lights` gives the robust weights.
  void Levels(const ObservedPatch& observed, const PredictedImage& image,
              const std::vector<BlockLight>& lights, std::vector<LevelSums>* sums);

  /// Products of the derivatives over all pixels, sums per block, and each pixel's weight.
  void Motions(const ObservedPatch& observed, const PredictedImage& image,
               const std::vector<BlockLight>& lights, bool blur, std::vector<float>* weight,
               FitProducts* products, std::vector<BlockMotions>* blocks);

  /// The equations of the light's gradient, from the sums of the last Motions().
  SlopeEquations Slopes(const std::vector<BlockLight>& lights,
                        const std::vector<BlockMotions>& blocks);

  /// Contribution of each cell to the equations of the last Motions(), with the blocks' light
  /// eliminated. `modules`: side of the marker; `edge_modules`: side of its black square.
  void Scores(int modules, int edge_modules, std::span<const BlockElimination> eliminations,
              CellScores* scores) const;

  /// Block of each pixel of the window; -1: not on a known part of the marker.
  void WriteBlocks(const ObservedPatch& observed, std::vector<std::int16_t>* block_of) const;

 private:
  struct TileRow {
    int y, rows, begin, count, first_tile, tiles;
  };
  /// A block's sums of the gradient's derivatives, with 1 and with the prediction.
  struct SlopeSums {
    std::array<double, 2> on_one{}, on_white{};
  };
  void LayTile(const MarkerPattern& pattern, const PlaneMap& map, std::size_t pixel,
               int blocks_along, const LightSlope& slope, std::size_t tile);
  /// Writes the light of the blocks per column.
  template <int kTile>
  LightOfColumns LightOfTiles(const TileRow& row, const std::vector<BlockLight>& lights);
  LightOfColumns Light(const TileRow& row, const std::vector<BlockLight>& lights);
  PixelRows Rows(const TileRow& row, const ObservedPatch& observed,
                 const PredictedImage& image) const;
  /// Reduces `sums` column sums to tile sums, stored from `to` on.
  void Reduce(const TileRow& row, int sums, float* to, std::ptrdiff_t to_stride);

  /// Per tile: its centre in half edges and the derivatives there, as in Tiles.
  struct Places {
    std::vector<float> u, v, u_x, u_y, v_x, v_y;
  };
  /// Per tile: its position in its block.
  struct InBlock {
    std::vector<unsigned char> block;
    std::vector<float> u, v;   ///< From the block's centre.
    std::vector<float> shade;  ///< Light on the tile relative to that on the block's centre.
  };
  /// Per column of a row of tiles, one array after the other.
  struct Columns {
    std::ptrdiff_t stride = 0;
    std::vector<float> sums, light;
  };

  const TileKernels* kernels_;
  int tile_ = 4;
  std::size_t tiles_ = 0, capacity_ = 0;
  std::vector<TileRow> rows_;
  std::vector<float> usable_;  ///< Per pixel.
  Places places_;
  InBlock in_block_;
  std::vector<float> gain_;  ///< Per tile.
  std::vector<float> tile_sums_;
  Columns columns_;
  std::vector<SlopeSums> slopes_;
};

}  // namespace pleinair::tracker
