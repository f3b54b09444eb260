#include "tracker/alignment/raster_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pleinair::tracker {

void RasterRows::Resize(const PixelWindow& window, PlaneMap* map, PredictedImage* image,
                        std::vector<RowRange>* ranges) {
  for (auto* values : {&map->column, &map->row, &map->column_x, &map->column_y, &map->row_x,
                       &map->row_y, &image->white, &image->white_x, &image->white_y}) {
    values->resize(window.size());
  }
  ranges->resize(static_cast<std::size_t>(std::max(window.height, 0)));
}

void RasterRows::Start(const Mat3& marker_from_undistorted, const WindowRays& rays, int pad,
                       int per_pixel) {
  const PixelWindow& window = rays.window;
  width_ = window.width;
  pad_ = pad;
  per_pixel_ = per_pixel;
  ring_.taps = (2 * pad + 1) * per_pixel;
  // Rows are padded for vectors; the blurred ones form a ring of as many as there are taps.
  count_ = width_ + 2 * pad;
  stride_ = (count_ + 2 * kRowSlack - 1) / kRowSlack * kRowSlack;
  map_rows_.resize(static_cast<std::size_t>(6) * stride_);
  samples_.resize(static_cast<std::size_t>(per_pixel) * per_pixel * stride_);
  ring_.blurred.resize(static_cast<std::size_t>(ring_.taps) * stride_);
  ring_.blurred_x.resize(ring_.blurred.size());
  ring_.rows.resize(ring_.taps);
  ring_.rows_x.resize(ring_.taps);
  float* scratch = map_rows_.data();
  here_ = {scratch,
           scratch + stride_,
           scratch + 2 * stride_,
           scratch + 3 * stride_,
           scratch + 4 * stride_,
           scratch + 5 * stride_};

  // With the window's centre as the origin, single precision suffices.
  const int rays_stride = width_ + 2 * kWindowBorder;
  const std::size_t middle =
      (static_cast<std::size_t>(window.height) / 2 + kWindowBorder) * rays_stride + rays_stride / 2;
  const bool has_origin = std::isfinite(rays.x[middle]) && std::isfinite(rays.y[middle]);
  projection_.origin_x = has_origin ? rays.x[middle] : 0.0F;
  projection_.origin_y = has_origin ? rays.y[middle] : 0.0F;
  const Mat3 from_origin = marker_from_undistorted *
                           Mat3{{1, 0, projection_.origin_x, 0, 1, projection_.origin_y, 0, 0, 1}};
  for (int i = 0; i < 9; ++i) {
    projection_.homography[i] = static_cast<float>(from_origin.m[i] / from_origin.m[8]);
  }
}

const MapRow& RasterRows::Evaluate(const RasterKernels& kernels, const WindowRays& rays, int y) {
  const int rays_stride = width_ + 2 * kWindowBorder;
  const std::size_t from =
      static_cast<std::size_t>(y + kWindowBorder) * rays_stride + kWindowBorder - pad_;
  kernels.map(
      {&rays.x[from], &rays.y[from], rays_stride, projection_.origin_x, projection_.origin_y},
      projection_.homography.data(), count_, here_);
  return here_;
}

void RasterRows::Keep(int y, PlaneMap* map) const {
  const std::size_t to = static_cast<std::size_t>(y) * width_;
  const std::size_t bytes = static_cast<std::size_t>(width_) * sizeof(float);
  std::memcpy(&map->column[to], here_.column + pad_, bytes);
  std::memcpy(&map->row[to], here_.row + pad_, bytes);
  std::memcpy(&map->column_x[to], here_.column_x + pad_, bytes);
  std::memcpy(&map->column_y[to], here_.column_y + pad_, bytes);
  std::memcpy(&map->row_x[to], here_.row_x + pad_, bytes);
  std::memcpy(&map->row_y[to], here_.row_y + pad_, bytes);
}

void RasterRows::Gather(int y, int begin) {
  for (int k = 0; k < ring_.taps; ++k) {
    const std::size_t at = InRing(y * per_pixel_ + k) + begin;
    ring_.rows[k] = &ring_.blurred[at];
    ring_.rows_x[k] = &ring_.blurred_x[at];
  }
}

}  // namespace pleinair::tracker
