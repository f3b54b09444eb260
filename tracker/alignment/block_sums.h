#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tracker/alignment/marker_raster.h"
#include "tracker/alignment/observed_patch.h"
#include "tracker/alignment/tile_kernels.h"
#include "tracker/marker_pattern.h"

namespace pleinair::tracker {

/// Sums over a block's pixels that say what light falls on it: see kLevelSums.
struct LevelSums {
  double pixels, w, wp, wi, wpp, wpi, wii, r, rp, ri, rpp, rpi;
};

/// The light on a block as a fit takes it.
struct BlockLight {
  float gain = 0.0F, offset = 0.0F;
  float inverse = 0.0F;  ///< 1 / (gain × robust share); 0: unknown, no residual counts.
  float robust_weight = 0.0F;
};

/// How much of what a block's pixels say about each parameter its gain and its offset could do.
struct BlockElimination {
  bool possible = false;
  std::array<double, kFitParameters> on_white{}, on_one{};
};

/// The equations of a fit told apart by where on the marker their pixels lie: by so many cells
/// along each side, whatever the blocks.
struct CellScores {
  static constexpr int kAlong = 8;
  std::array<std::array<double, kFitParameters>, kAlong * kAlong> gradient{};  ///< Σ gain w r J,
  std::array<int, kAlong * kAlong> tiles{};  ///< … from so many tiles.
};

/// The light's slope over the marker as two more parameters of a fit, for which the light of the
/// blocks is eliminated: φ_u = u' (gain p + offset) and φ_v, u' and v' in half edges from the
/// middle of each block; inner products with the final weights.
struct SlopeEquations {
  std::array<std::array<double, 2>, 2> own{};                ///< φ with φ,
  std::array<std::array<double, kFitParameters>, 2> with{};  ///< … with gain J,
  std::array<double, 2> right{};                             ///< … and with what is left over.
  bool known = false;                                        ///< They tell the slope.
};

/// Change of the logarithm of light by half edges to the right and down, within each block.
struct LightSlope {
  double by_u = 0.0, by_v = 0.0;
};

/// Adds up pixels for each block of a marker: first by tiles of 2×2 or 4×4 pixels, which belong to
/// the block their middle lies in. Within a tile the place on the marker and the map's derivatives
/// are taken as one, so that only slopes are summed pixel by pixel.
class BlockSums {
 public:
  BlockSums();
  /// With the kernels to work with, for tests.
  explicit BlockSums(const TileKernels& kernels) : kernels_(&kernels) {}

  /// Cuts the window into tiles and tells which pixels are usable. `ranges` as from
  /// MarkerRaster::RenderMarkerOnly.
  void Lay(const MarkerPattern& pattern, const KnownPart& known, const ObservedPatch& observed,
           const PlaneMap& map, const std::vector<RowRange>& ranges, int tile, int blocks_along,
           const LightSlope& slope = {});

  /// One sum for each block, with the light of the blocks for the robust weights.
  void Levels(const ObservedPatch& observed, const PredictedImage& image,
              const std::vector<BlockLight>& lights, std::vector<LevelSums>* sums);

  /// Products of the derivatives over all pixels and sums by blocks; each pixel's weight.
  void Motions(const ObservedPatch& observed, const PredictedImage& image,
               const std::vector<BlockLight>& lights, bool blur, std::vector<float>* weight,
               FitProducts* products, std::vector<BlockMotions>* blocks);

  /// The equations of the light's slope, from the sums that Motions made last.
  SlopeEquations Slopes(const std::vector<BlockLight>& lights,
                        const std::vector<BlockMotions>& blocks);

  /// What each cell's pixels say in the equations that Motions made last, with the light of the
  /// blocks eliminated. `modules` is the marker's side, `edge_modules` that of its square.
  void Scores(int modules, int edge_modules, std::span<const BlockElimination> eliminations,
              CellScores* scores) const;

  /// Block of each pixel of the window; -1: not of what is known of the marker.
  void WriteBlocks(const ObservedPatch& observed, std::vector<std::int16_t>* block_of) const;

 private:
  struct TileRow {
    int y, rows, begin, count, first_tile, tiles;
  };
  /// A block's sums of the slope's derivatives with 1 and with what is predicted of it.
  struct SlopeSums {
    std::array<double, 2> on_one{}, on_white{};
  };
  void LayTile(const MarkerPattern& pattern, const PlaneMap& map, std::size_t pixel,
               int blocks_along, const LightSlope& slope, std::size_t tile);
  /// Writes out the light of the blocks by columns.
  template <int kTile>
  LightOfColumns LightOfTiles(const TileRow& row, const std::vector<BlockLight>& lights);
  LightOfColumns Light(const TileRow& row, const std::vector<BlockLight>& lights);
  PixelRows Rows(const TileRow& row, const ObservedPatch& observed,
                 const PredictedImage& image) const;
  /// Column sums to tile sums, `sums` of them, from `to` on.
  void Reduce(const TileRow& row, int sums, float* to, std::ptrdiff_t to_stride);

  /// By tile: its middle in half edges and the derivatives by it, as in Tiles.
  struct Places {
    std::vector<float> u, v, u_x, u_y, v_x, v_y;
  };
  /// By tile: how it lies in its block.
  struct InBlock {
    std::vector<unsigned char> block;
    std::vector<float> u, v;   ///< From the block's middle.
    std::vector<float> shade;  ///< Light on the tile over that on the block's middle.
  };
  /// By column of a row of tiles, one array after the other.
  struct Columns {
    std::ptrdiff_t stride = 0;
    std::vector<float> sums, light;
  };

  const TileKernels* kernels_;
  int tile_ = 4;
  std::size_t tiles_ = 0, capacity_ = 0;
  std::vector<TileRow> rows_;
  std::vector<float> usable_;  ///< By pixel.
  Places places_;
  InBlock in_block_;
  std::vector<float> gain_;  ///< By tile.
  std::vector<float> tile_sums_;
  Columns columns_;
  std::vector<SlopeSums> slopes_;
};

}  // namespace pleinair::tracker
