#include "tracker/alignment/block_sums.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

constexpr int kWholeVector = 16;  ///< The widest vectors' lanes.

}  // namespace

BlockSums::BlockSums() : kernels_(&SimdTileKernels()) {}

void BlockSums::Lay(const PrintPattern& pattern, const KnownPart& known, const SeenWindow& seen,
                    const PrintMap& map, const std::vector<RowRange>& ranges, int tile,
                    int blocks_along) {
  const int width = seen.rays.window.width, height = seen.rays.window.height;
  tile_ = tile;
  capacity_ = static_cast<std::size_t>((width + tile - 1) / tile) * ((height + tile - 1) / tile) +
              kTileSlack;
  column_stride_ = width + 2 * kTileSlack;
  for (auto* values : {&u_, &v_, &u_x_, &u_y_, &v_x_, &v_y_, &gain_}) values->resize(capacity_);
  block_.resize(capacity_);
  tile_sums_.resize(capacity_ * kMotionSums);
  column_sums_.resize(static_cast<std::size_t>(column_stride_) * kMotionSums);
  column_light_.resize(static_cast<std::size_t>(column_stride_) * 4);
  usable_.resize(seen.value.size());
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
                     known, &seen.certainty[at], count, &usable_[at]);
    }
    const int middle_y = std::min(y + tile / 2 - 1, height - 1);
    for (int t = 0; t < rows_.back().tiles; ++t, ++tiles_) {
      const int middle_x = std::min(range.begin + t * tile + tile / 2 - 1, width - 1);
      LayTile(pattern, map, static_cast<std::size_t>(middle_y) * width + middle_x, blocks_along,
              tiles_);
    }
  }
}

void BlockSums::LayTile(const PrintPattern& pattern, const PrintMap& map, std::size_t pixel,
                        int blocks_along, std::size_t tile) {
  const float modules = static_cast<float>(pattern.modules);
  const float per_half = 2.0F / static_cast<float>(pattern.edge_modules);
  // The tile's middle is half a pixel right of and below this pixel's centre.
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
  block_[tile] = static_cast<unsigned char>(index(r) * blocks_along + index(c));
  u_[tile] = (c - 0.5F * modules) * per_half;
  v_[tile] = (r - 0.5F * modules) * per_half;
  const float inverse = 1.0F / ((column_x * row_y - column_y * row_x) * per_half);
  u_x_[tile] = row_y * inverse;
  u_y_[tile] = -row_x * inverse;
  v_x_[tile] = -column_y * inverse;
  v_y_[tile] = column_x * inverse;
}

template <int kTile>
LightOfColumns BlockSums::LightOfTiles(const TileRow& row, const std::vector<BlockLight>& lights) {
  float* gain = column_light_.data();
  float *offset = gain + column_stride_, *inverse = offset + column_stride_;
  float* belief = inverse + column_stride_;
  const unsigned char* block = &block_[row.first_tile];
  for (int t = 0; t < row.tiles; ++t) {
    const BlockLight light = lights[block[t]];
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) gain[x] = light.gain;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) offset[x] = light.offset;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) inverse[x] = light.inverse;
    for (int x = t * kTile; x < (t + 1) * kTile; ++x) belief[x] = light.belief;
  }
  return {gain, offset, inverse};
}

LightOfColumns BlockSums::Light(const TileRow& row, const std::vector<BlockLight>& lights) {
  return tile_ == 4 ? LightOfTiles<4>(row, lights) : LightOfTiles<2>(row, lights);
}

PixelRows BlockSums::Rows(const TileRow& row, const SeenWindow& seen,
                          const PrintPicture& picture) const {
  const int width = seen.rays.window.width;
  const std::size_t at = static_cast<std::size_t>(row.y) * width + row.begin;
  return {width, row.rows, row.count, &picture.white[at], &seen.value[at], &usable_[at]};
}

void BlockSums::Reduce(const TileRow& row, int sums, float* to, std::ptrdiff_t to_stride) {
  for (int q = 0; q < sums; ++q) {
    float* columns = &column_sums_[static_cast<std::size_t>(q * column_stride_)];
    for (int x = row.count; x < row.tiles * tile_; ++x) columns[x] = 0.0F;
  }
  kernels_->reduce(column_sums_.data(), column_stride_, sums, tile_, row.tiles, to, to_stride);
}

void BlockSums::Levels(const SeenWindow& seen, const PrintPicture& picture,
                       const std::vector<BlockLight>& lights, std::vector<LevelSums>* sums) {
  sums->assign(lights.size(), LevelSums{});
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(capacity_);
  for (const TileRow& row : rows_) {
    kernels_->levels(Rows(row, seen, picture), Light(row, lights), column_stride_,
                     column_sums_.data());
    Reduce(row, kLevelSums, tile_sums_.data(), stride);
    for (int t = 0; t < row.tiles; ++t) {
      const float* from = &tile_sums_[t];
      LevelSums& of = (*sums)[block_[row.first_tile + t]];
      for (double* sum : {&of.pixels, &of.w, &of.wp, &of.wi, &of.wpp, &of.wpi, &of.wii, &of.r,
                          &of.rp, &of.ri, &of.rpp, &of.rpi}) {
        *sum += *from;
        from += stride;
      }
    }
  }
}

void BlockSums::Motions(const SeenWindow& seen, const PrintPicture& picture,
                        const std::vector<BlockLight>& lights, bool blur,
                        std::vector<float>* weight, FitProducts* products,
                        std::vector<BlockMotions>* blocks) {
  const int width = seen.rays.window.width, height = seen.rays.window.height;
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(capacity_);
  for (const TileRow& row : rows_) {
    const std::size_t at = static_cast<std::size_t>(row.y) * width + row.begin;
    const LightOfColumns light = Light(row, lights);
    kernels_->motions(
        Rows(row, seen, picture),
        {&picture.white_x[at], &picture.white_y[at], blur, row.y, height, row.begin, width}, light,
        light.inverse + column_stride_, &(*weight)[at], column_stride_, column_sums_.data());
    Reduce(row, blur ? kMotionSums : kSlopeSums, &tile_sums_[row.first_tile], stride);
    for (int t = 0; t < row.tiles; ++t) {
      const std::size_t tile = static_cast<std::size_t>(row.first_tile) + t;
      const BlockLight& of = lights[block_[tile]];
      // Where the map folds up nothing can be learnt.
      gain_[tile] = of.belief > 0.0F && std::isfinite(u_x_[tile] + v_y_[tile]) ? of.gain : 0.0F;
    }
  }
  if (!blur) {
    std::fill(tile_sums_.begin() + kSlopeSums * stride, tile_sums_.end(), 0.0F);
  }
  *products = FitProducts{};
  blocks->assign(lights.size(), BlockMotions{});
  kernels_->products(
      {static_cast<int>(tiles_), stride, tile_sums_.data(), u_.data(), v_.data(), u_x_.data(),
       u_y_.data(), v_x_.data(), v_y_.data(), gain_.data(), block_.data()},
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
    const BlockElimination& eliminate = eliminations[block_[t]];
    if (!(gain > 0.0) || !eliminate.possible) continue;
    const auto sum = [&](int q) { return static_cast<double>(tile_sums_[q * capacity_ + t]); };
    const double u = u_[t], v = v_[t], r = sum(3), rp = sum(4);
    const double p_u = u_x_[t] * sum(10) + u_y_[t] * sum(11);
    const double p_v = v_x_[t] * sum(10) + v_y_[t] * sum(11);
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

void BlockSums::WriteBlocks(const SeenWindow& seen, std::vector<std::int16_t>* block_of) const {
  const int width = seen.rays.window.width, shift = tile_ == 4 ? 2 : 1;
  std::fill(block_of->begin(), block_of->end(), static_cast<std::int16_t>(-1));
  for (const TileRow& row : rows_) {
    const unsigned char* block = &block_[row.first_tile];
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
