#include "tracker/alignment/block_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tracker/alignment/light_elimination.h"

namespace pleinair::tracker {
namespace {

constexpr int kWholeVector = 16;  ///< Lanes of the widest vectors.

}  // namespace

BlockSums::BlockSums() : kernels_(&SimdTileKernels()) {}

void BlockSums::Lay(const MarkerPattern& pattern, const KnownPart& known,
                    const ObservedPatch& observed, const PlaneMap& map,
                    const std::vector<RowRange>& ranges, int tile, int blocks_along,
                    const LightSlope& slope) {
  const int width = observed.rays.window.width, height = observed.rays.window.height;
  tile_ = tile;
  capacity_ = static_cast<std::size_t>((width + tile - 1) / tile) * ((height + tile - 1) / tile) +
              kTileSlack;
  columns_.stride = width + 2 * kTileSlack;
  for (auto* values : {&places_.u, &places_.v, &places_.u_x, &places_.u_y, &places_.v_x,
                       &places_.v_y, &gain_, &in_block_.u, &in_block_.v, &in_block_.shade})
    values->resize(capacity_);
  in_block_.block.resize(capacity_);
  tile_sums_.resize(capacity_ * kMotionSums);
  columns_.sums.resize(static_cast<std::size_t>(columns_.stride) * kMotionSums);
  columns_.light.resize(static_cast<std::size_t>(columns_.stride) * 4);
  usable_.resize(observed.value.size());
  rows_.clear();
  tiles_ = 0;
  for (int y = 0; y < height; y += tile) {
    const int rows = std::min(tile, height - y);
    RowRange range{width, 0};
    for (int j = 0; j < rows; ++j) {
      if (ranges[y + j].begin >= ranges[y + j].end) continue;
      range.begin = std::min(range.begin, ranges[y + j].begin);
      range.end = std::max(range.end, ranges[y + j].end);
    }
    if (range.begin >= range.end) continue;
    // Wide enough for a whole vector, if the window is.
    if (range.end - range.begin < kWholeVector) {
      range.begin = std::max(0, std::min(range.begin, width - kWholeVector));
      range.end = std::min(width, std::max(range.end, range.begin + kWholeVector));
    }
    range.begin = range.begin / tile * tile;
    range.end = std::min(width, (range.end + tile - 1) / tile * tile);
    const int count = range.end - range.begin;
    rows_.push_back(
        {y, rows, range.begin, count, static_cast<int>(tiles_), (count + tile - 1) / tile});
    for (int j = 0; j < rows; ++j) {
      const std::size_t at = static_cast<std::size_t>(y + j) * width + range.begin;
      kernels_->mark({&map.column[at], &map.row[at], &map.column_x[at], &map.column_y[at],
                      &map.row_x[at], &map.row_y[at]},
                     known, &observed.inverse_variance[at], count, &usable_[at]);
    }
    const int middle_y = std::min(y + tile / 2 - 1, height - 1);
    for (int t = 0; t < rows_.back().tiles; ++t, ++tiles_) {
      const int middle_x = std::min(range.begin + t * tile + tile / 2 - 1, width - 1);
      LayTile(pattern, map, static_cast<std::size_t>(middle_y) * width + middle_x, blocks_along,
              slope, tiles_);
    }
  }
}

void BlockSums::LayTile(const MarkerPattern& pattern, const PlaneMap& map, std::size_t pixel,
                        int blocks_along, const LightSlope& slope, std::size_t tile) {
  const float modules = static_cast<float>(pattern.modules);
  const float per_half = 2.0F / static_cast<float>(pattern.edge_modules);
  // The tile's centre is half a pixel right of and below this pixel's centre.
  const float column_x = map.column_x[pixel], column_y = map.column_y[pixel];
  const float row_x = map.row_x[pixel], row_y = map.row_y[pixel];
  const float c = map.column[pixel] + 0.5F * (column_x + column_y);
  const float r = map.row[pixel] + 0.5F * (row_x + row_y);
  const float per_block = static_cast<float>(blocks_along) / modules;
  const auto index = [&](float at) {
    return at > 0.0F
               ? static_cast<int>(std::min(at * per_block, static_cast<float>(blocks_along) - 0.5F))
               : 0;
  };
  const int block_column = index(c), block_row = index(r);
  in_block_.block[tile] = static_cast<unsigned char>(block_row * blocks_along + block_column);
  places_.u[tile] = (c - 0.5F * modules) * per_half;
  places_.v[tile] = (r - 0.5F * modules) * per_half;
  in_block_.u[tile] = (c - (static_cast<float>(block_column) + 0.5F) / per_block) * per_half;
  in_block_.v[tile] = (r - (static_cast<float>(block_row) + 0.5F) / per_block) * per_half;
  // Padé approximant (2/2) of the exponential: accurate to 0.15 % within its range. Beyond, it is
  // clamped, and the tile does not contribute to the slope.
  const float exponent = static_cast<float>(slope.by_u) * in_block_.u[tile] +
                         static_cast<float>(slope.by_v) * in_block_.v[tile];
  const float half = 0.5F * std::clamp(exponent, -1.0F, 1.0F);
  const float even = 3.0F + half * half;
  in_block_.shade[tile] = (even + 3.0F * half) / (even - 3.0F * half);
  if (!(std::fabs(exponent) <= 1.0F)) in_block_.u[tile] = in_block_.v[tile] = 0.0F;
  const float inverse = 1.0F / ((column_x * row_y - column_y * row_x) * per_half);
  places_.u_x[tile] = row_y * inverse;
  places_.u_y[tile] = -row_x * inverse;
  places_.v_x[tile] = -column_y * inverse;
  places_.v_y[tile] = column_x * inverse;
}

template <int kTile>
LightOfColumns BlockSums::LightOfTiles(const TileRow& row, const std::vector<BlockLight>& lights) {
  float* gain = columns_.light.data();
  float *offset = gain + columns_.stride, *inverse = offset + columns_.stride;
  float* robust_weight = inverse + columns_.stride;
  const unsigned char* block = &in_block_.block[row.first_tile];
  for (int t = 0; t < row.tiles; ++t) {
    BlockLight light = lights[block[t]];
    const float shade = in_block_.shade[row.first_tile + t];
    light.gain *= shade;
    light.offset *= shade;
    light.inverse /= shade;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) gain[x] = light.gain;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) offset[x] = light.offset;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) inverse[x] = light.inverse;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) robust_weight[x] = light.robust_weight;
  }
  return {gain, offset, inverse};
}

LightOfColumns BlockSums::Light(const TileRow& row, const std::vector<BlockLight>& lights) {
  return tile_ == 4 ? LightOfTiles<4>(row, lights) : LightOfTiles<2>(row, lights);
}

PixelRows BlockSums::Rows(const TileRow& row, const ObservedPatch& observed,
                          const PredictedImage& image) const {
  const int width = observed.rays.window.width;
  const std::size_t at = static_cast<std::size_t>(row.y) * width + row.begin;
  return {width, row.rows, row.count, &image.white[at], &observed.value[at], &usable_[at]};
}

void BlockSums::Reduce(const TileRow& row, int sums, float* to, std::ptrdiff_t to_stride) {
  for (int q = 0; q < sums; ++q) {
    float* columns = &columns_.sums[static_cast<std::size_t>(q * columns_.stride)];
    for (int x = row.count; x < row.tiles * tile_; ++x) columns[x] = 0.0F;
  }
  kernels_->reduce(columns_.sums.data(), columns_.stride, sums, tile_, row.tiles, to, to_stride);
}

void BlockSums::Levels(const ObservedPatch& observed, const PredictedImage& image,
                       const std::vector<BlockLight>& lights, std::vector<LevelSums>* sums) {
  sums->assign(lights.size(), LevelSums{});
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(capacity_);
  for (const TileRow& row : rows_) {
    kernels_->levels(Rows(row, observed, image), Light(row, lights), columns_.stride,
                     columns_.sums.data());
    Reduce(row, kLevelSums, tile_sums_.data(), stride);
    for (int t = 0; t < row.tiles; ++t) {
      const float* from = &tile_sums_[t];
      LevelSums& of = (*sums)[in_block_.block[row.first_tile + t]];
      // The prediction is p times the shading.
      const float shade = in_block_.shade[row.first_tile + t], squared = shade * shade;
      const std::array<std::pair<double*, float>, kLevelSums> all{{{&of.pixels, 1.0F},
                                                                   {&of.w, squared},
                                                                   {&of.wp, squared},
                                                                   {&of.wi, shade},
                                                                   {&of.wpp, squared},
                                                                   {&of.wpi, shade},
                                                                   {&of.wii, 1.0F},
                                                                   {&of.r, squared},
                                                                   {&of.rp, squared},
                                                                   {&of.ri, shade},
                                                                   {&of.rpp, squared},
                                                                   {&of.rpi, shade}}};
      for (const auto& [sum, factor] : all) {
        *sum += *from * factor;
        from += stride;
      }
    }
  }
}

void BlockSums::Motions(const ObservedPatch& observed, const PredictedImage& image,
                        const std::vector<BlockLight>& lights, bool blur,
                        std::vector<float>* weight, FitProducts* products,
                        std::vector<BlockMotions>* blocks) {
  const int width = observed.rays.window.width, height = observed.rays.window.height;
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(capacity_);
  for (const TileRow& row : rows_) {
    const std::size_t at = static_cast<std::size_t>(row.y) * width + row.begin;
    const LightOfColumns light = Light(row, lights);
    kernels_->motions(
        Rows(row, observed, image),
        {&image.white_x[at], &image.white_y[at], blur, row.y, height, row.begin, width}, light,
        light.inverse + columns_.stride, &(*weight)[at], columns_.stride, columns_.sums.data());
    Reduce(row, blur ? kMotionSums : kSlopeSums, &tile_sums_[row.first_tile], stride);
    for (int t = 0; t < row.tiles; ++t) {
      const std::size_t tile = static_cast<std::size_t>(row.first_tile) + t;
      const BlockLight& of = lights[in_block_.block[tile]];
      // Where the map folds over, the pixels have no information.
      gain_[tile] = of.robust_weight > 0.0F && std::isfinite(places_.u_x[tile] + places_.v_y[tile])
                        ? of.gain * in_block_.shade[tile]
                        : 0.0F;
    }
  }
  if (!blur) {
    std::fill(tile_sums_.begin() + kSlopeSums * stride, tile_sums_.end(), 0.0F);
  }
  *products = FitProducts{};
  blocks->assign(lights.size(), BlockMotions{});
  kernels_->products({static_cast<int>(tiles_), stride, tile_sums_.data(), places_.u.data(),
                      places_.v.data(), places_.u_x.data(), places_.u_y.data(), places_.v_x.data(),
                      places_.v_y.data(), gain_.data(), in_block_.block.data()},
                     products, blocks->data());
}

void BlockSums::Scores(int modules, int edge_modules,
                       std::span<const BlockElimination> eliminations, CellScores* scores) const {
  *scores = CellScores{};
  const double reach = static_cast<double>(modules) / edge_modules;  // In half edges.
  const auto index = [&](double at) {
    const double cell = (at + reach) / (2.0 * reach) * CellScores::kAlong;
    return static_cast<int>(std::clamp(cell, 0.0, CellScores::kAlong - 0.5));
  };
  for (std::size_t t = 0; t < tiles_; ++t) {
    const double gain = gain_[t];
    const BlockElimination& eliminate = eliminations[in_block_.block[t]];
    if (!(gain > 0.0) || !eliminate.possible) continue;
    const auto sum = [&](int q) { return static_cast<double>(tile_sums_[q * capacity_ + t]); };
    const double u = places_.u[t], v = places_.v[t], r = sum(3), rp = sum(4);
    const double p_u = places_.u_x[t] * sum(10) + places_.u_y[t] * sum(11);
    const double p_v = places_.v_x[t] * sum(10) + places_.v_y[t] * sum(11);
    const double along = p_u * u + p_v * v;
    // As in TileKernels' products.
    const std::array<double, kFitParameters> rj{-p_u,     -p_u * u,  -p_u * v,  -p_v,   -p_v * u,
                                                -p_v * v, along * u, along * v, sum(17)};
    const int cell = index(v) * CellScores::kAlong + index(u);
    std::array<double, kFitParameters>& gradient = scores->gradient[cell];
    for (int a = 0; a < kFitParameters; ++a) {
      gradient[a] += gain * (rj[a] - eliminate.on_white[a] * rp - eliminate.on_one[a] * r);
    }
    ++scores->tiles[cell];
  }
}

SlopeEquations BlockSums::Slopes(const std::vector<BlockLight>& lights,
                                 const std::vector<BlockMotions>& blocks) {
  SlopeEquations all;
  slopes_.assign(blocks.size(), SlopeSums{});
  for (std::size_t t = 0; t < tiles_; ++t) {
    const double gain = gain_[t];
    if (!(gain > 0.0)) continue;
    const int block = in_block_.block[t];
    const double offset = static_cast<double>(lights[block].offset) * in_block_.shade[t];
    const auto sum = [&](int q) { return static_cast<double>(tile_sums_[q * capacity_ + t]); };
    const std::array<double, 2> along{in_block_.u[t], in_block_.v[t]};
    // φ is along times this.
    const double one = gain * sum(1) + offset * sum(0), white = gain * sum(2) + offset * sum(1);
    const double square = gain * white + offset * one;
    const double left = gain * sum(4) + offset * sum(3);
    const double x = gain * sum(8) + offset * sum(6), y = gain * sum(9) + offset * sum(7);
    const double b = gain * (gain * sum(16) + offset * sum(15));
    const double u = places_.u[t], v = places_.v[t];
    const double pu = gain * (places_.u_x[t] * x + places_.u_y[t] * y),
                 pv = gain * (places_.v_x[t] * x + places_.v_y[t] * y);
    const double inwards = pu * u + pv * v;
    // As in TileKernels' products.
    const std::array<double, kFitParameters> j{-pu,     -pu * u,     -pu * v,     -pv, -pv * u,
                                               -pv * v, inwards * u, inwards * v, b};
    for (int i = 0; i < 2; ++i) {
      slopes_[block].on_one[i] += along[i] * one;
      slopes_[block].on_white[i] += along[i] * white;
      all.right[i] += along[i] * left;
      for (int k = 0; k < 2; ++k) all.own[i][k] += along[i] * along[k] * square;
      for (int a = 0; a < kFitParameters; ++a) all.with[i][a] += along[i] * j[a];
    }
  }
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    const BlockMotions& sums = blocks[block];
    const LightElimination eliminate(sums);
    const auto& [on_one, on_white] = slopes_[block];
    const double gain = lights[block].gain;
    if (!(gain > 0.0) || !eliminate.possible) continue;
    for (int i = 0; i < 2; ++i) {
      const double white = eliminate.OnPattern(on_one[i], on_white[i]);
      const double one = eliminate.OnOne(on_one[i], on_white[i]);
      all.right[i] -= white * sums.rp + one * sums.r;
      for (int k = 0; k < 2; ++k) {
        all.own[i][k] -= white * on_white[k] + one * on_one[k];
      }
      for (int a = 0; a < kFitParameters; ++a) {
        all.with[i][a] -= gain * (white * sums.pj[a] + one * sums.j[a]);
      }
    }
  }
  return all;
}

void BlockSums::WriteBlocks(const ObservedPatch& observed,
                            std::vector<std::int16_t>* block_of) const {
  const int width = observed.rays.window.width, shift = tile_ == 4 ? 2 : 1;
  std::fill(block_of->begin(), block_of->end(), static_cast<std::int16_t>(-1));
  for (const TileRow& row : rows_) {
    const unsigned char* block = &in_block_.block[row.first_tile];
    for (int j = 0; j < row.rows; ++j) {
      const std::size_t at = static_cast<std::size_t>(row.y + j) * width + row.begin;
      const float* usable = &usable_[at];
      std::int16_t* of = &(*block_of)[at];
      for (int x = 0; x < row.count; ++x) {
        if (usable[x] >= 0.0F) of[x] = static_cast<std::int16_t>(block[x >> shift]);
      }
    }
  }
}

}  // namespace pleinair::tracker
