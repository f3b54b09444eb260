#include "tracker/alignment/marker_raster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracker/alignment/raster_kernels.h"
#include "tracker/alignment/raster_rows.h"

namespace pleinair::tracker {
namespace {

constexpr double kKernelSigmas = 3.0;
constexpr double kSharpestBlur_px = 0.12;
/// From this blur on one sample per pixel suffices if modules are no smaller than pixels.
constexpr double kSmoothBlur_px = 1.15;
/// Pixels around the marker that are predicted too, for differences of neighbours.
constexpr float kAroundMarker_px = 2.0F;
constexpr int kProbes = 6;  ///< Along each side of the window.

}  // namespace

void LookUpRays(const LensGrid& lens, const PixelWindow& window, WindowRays* rays) {
  rays->window = window;
  const int width = window.width + 2 * kWindowBorder, height = window.height + 2 * kWindowBorder;
  rays->x.resize(static_cast<std::size_t>(width) * height + kRowSlack);
  rays->y.resize(rays->x.size());
  for (int j = 0; j < height; ++j) {
    const std::size_t at = static_cast<std::size_t>(j) * width;
    lens.UndistortRow(window.Full(window.x0 - kWindowBorder), window.Scale(), width,
                      window.Full(window.y0 + j - kWindowBorder), &rays->x[at], &rays->y[at]);
  }
}

MarkerRaster::MarkerRaster() : MarkerRaster(SimdRasterKernels()) {}
MarkerRaster::MarkerRaster(const RasterKernels& kernels)
    : kernels_(&kernels), rows_(std::make_unique<RasterRows>()) {}
MarkerRaster::~MarkerRaster() = default;
MarkerRaster::MarkerRaster(MarkerRaster&&) noexcept = default;
MarkerRaster& MarkerRaster::operator=(MarkerRaster&&) noexcept = default;

void MarkerRaster::SetKernel(double blur_px, int per_pixel, int* pad) {
  // The box of each sample and the bins of the kernel blur as well: subtract their variances.
  const double bin = 1.0 / per_pixel;
  const double variance =
      std::max(blur_px * blur_px - 2.0 * bin * bin / 12.0, kSharpestBlur_px * kSharpestBlur_px);
  const double sigma = std::sqrt(variance);
  *pad = std::min(kWindowBorder - 1, static_cast<int>(std::ceil(kKernelSigmas * sigma)));
  const int taps = (2 * *pad + 1) * per_pixel;
  kernel_.resize(taps);
  kernel_slope_.resize(taps);
  // The blurred box of a pixel, averaged over each bin, is a second difference of ∫Φ(x/σ). The
  // steps are one pixel and one bin; bins divide pixels.
  const int edges = taps + per_pixel + 1;
  below_.resize(edges);
  primitive_.resize(edges);
  for (int k = 0; k < edges; ++k) {
    const double z = (k * bin - 1.0 - *pad) / sigma;
    const double density =
        std::exp(-0.5 * z * z) * (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
    below_[k] = 0.5 * std::erfc(-z / std::numbers::sqrt2);
    primitive_[k] = sigma * (z * below_[k] + density);
  }
  double sum = 0.0;
  for (int k = 0; k < taps; ++k) {
    const double weight = primitive_[k + 1 + per_pixel] - primitive_[k + 1] -
                          primitive_[k + per_pixel] + primitive_[k];
    kernel_[k] = static_cast<float>(weight);
    // The image is ∫ marker(p + t) K(t) dt, so its slope is -∫ marker(p + t) K'(t) dt.
    kernel_slope_[k] = static_cast<float>(below_[k + per_pixel] - below_[k] -
                                          below_[k + 1 + per_pixel] + below_[k + 1]);
    sum += weight;
  }
  for (float& weight : kernel_) weight = static_cast<float>(weight / sum);
}

void MarkerRaster::SetNodes(const MarkerPattern& pattern) {
  if (nodes_of_ == pattern.white) return;
  const bool other_size = nodes_of_.size() != pattern.white.size();
  const int last = pattern.modules - 1, nodes = pattern.modules + 1;
  nodes_.resize(static_cast<std::size_t>(nodes) * nodes);
  row_nodes_.resize(static_cast<std::size_t>(pattern.modules) * nodes);
  row_modules_.resize(static_cast<std::size_t>(nodes) + 3);
  // Four modules of each row at a time, then four rows; for another marker of the same kind only
  // the differences.
  int first_changed = pattern.modules, last_changed = -1;
  for (int y = 0; y < pattern.modules; ++y) {
    const std::size_t from = static_cast<std::size_t>(y) * pattern.modules;
    const std::uint8_t* row = &pattern.white[from];
    if (!other_size && std::equal(row, row + pattern.modules, &nodes_of_[from])) continue;
    first_changed = std::min(first_changed, y);
    last_changed = y;
    std::uint8_t* modules = row_modules_.data();  // … repeated twice beyond either end.
    std::copy(row, row + pattern.modules, modules + 2);
    modules[0] = modules[1] = row[0];
    modules[nodes + 1] = modules[nodes + 2] = row[last];
    std::uint32_t* around = &row_nodes_[static_cast<std::size_t>(y) * nodes];
    for (int i = 0; i < nodes; ++i) {
      around[i] = static_cast<std::uint32_t>(modules[i] | modules[i + 1] << 1 |
                                             modules[i + 2] << 2 | modules[i + 3] << 3);
    }
  }
  nodes_of_ = pattern.white;
  for (int j = std::max(0, first_changed - 1); j <= std::min(last_changed + 2, last + 1); ++j) {
    const std::uint32_t* rows[4];
    for (int k = 0; k < 4; ++k) {
      rows[k] = &row_nodes_[static_cast<std::size_t>(std::clamp(j - 2 + k, 0, last)) * nodes];
    }
    std::uint32_t* to = &nodes_[static_cast<std::size_t>(j) * nodes];
    for (int i = 0; i < nodes; ++i) {
      to[i] = rows[0][i] | rows[1][i] << 4 | rows[2][i] << 8 | rows[3][i] << 12;
    }
  }
}

int MarkerRaster::SamplesPerPixel(const MarkerPattern& pattern,
                                  const Mat3& modules_from_undistorted, const WindowRays& rays,
                                  double blur_px) const {
  const PixelWindow& window = rays.window;
  const int stride = window.width + 2 * kWindowBorder;
  const Mat3& m = modules_from_undistorted;
  double finest = 0.0;  // Maximum number of modules per pixel.
  for (int j = 0; j <= kProbes; ++j) {
    for (int i = 0; i <= kProbes; ++i) {
      const int x = (window.width - 1) * i / kProbes, y = (window.height - 1) * j / kProbes;
      const std::size_t at =
          static_cast<std::size_t>(y + kWindowBorder) * stride + kWindowBorder + x;
      const Vec3 point = m * Vec3{rays.x[at], rays.y[at], 1.0};
      const double w = 1.0 / point.z, column = point.x * w, row = point.y * w;
      if (!(column > 0 && column < pattern.modules && row > 0 && row < pattern.modules)) continue;
      const double cx = (m.m[0] - m.m[6] * column) * w, cy = (m.m[1] - m.m[7] * column) * w;
      const double rx = (m.m[3] - m.m[6] * row) * w, ry = (m.m[4] - m.m[7] * row) * w;
      finest = std::max(finest, std::max(cx * cx + cy * cy, rx * rx + ry * ry));
    }
  }
  // The lens's local scale is ignored: it is close enough to 1 for choosing the number of samples.
  finest = std::sqrt(finest) * window.Scale();
  if (finest <= 1.0 && blur_px >= kSmoothBlur_px) return 1;
  return static_cast<int>(std::ceil(std::clamp(finest, 2.0, 6.0)));
}

void MarkerRaster::Render(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
                          const WindowRays& rays, double blur_px, PlaneMap* map,
                          PredictedImage* image) {
  RenderRows(pattern, modules_from_undistorted, rays, blur_px, true, map, image, &all_);
}

void MarkerRaster::RenderMarkerOnly(const MarkerPattern& pattern,
                                    const Mat3& modules_from_undistorted, const WindowRays& rays,
                                    double blur_px, PlaneMap* map, PredictedImage* image,
                                    std::vector<RowRange>* ranges) {
  RenderRows(pattern, modules_from_undistorted, rays, blur_px, false, map, image, ranges);
}

void MarkerRaster::RenderRows(const MarkerPattern& pattern, const Mat3& modules_from_undistorted,
                              const WindowRays& rays, double blur_px, bool everywhere,
                              PlaneMap* map, PredictedImage* image, std::vector<RowRange>* ranges) {
  const PixelWindow& window = rays.window;
  RasterRows::Resize(window, map, image, ranges);
  if (window.empty()) return;
  SetNodes(pattern);
  const int per_pixel = SamplesPerPixel(pattern, modules_from_undistorted, rays, blur_px);
  int pad = 0;
  SetKernel(blur_px, per_pixel, &pad);
  const BlurTaps taps{kernel_.data(), kernel_slope_.data(), per_pixel, 2 * pad + 1};
  rows_->Start(modules_from_undistorted, rays, pad, per_pixel);
  const int count = rows_->count();
  const NodeTable table{nodes_.data(), pattern.modules + 1};
  const float modules = static_cast<float>(pattern.modules);

  for (int y = -pad; y < window.height + pad; ++y) {
    const MapRow& here = rows_->Evaluate(*kernels_, rays, y);
    RowRanges of_marker{{0, count}, {0, count}};
    if (!everywhere) {
      of_marker = kernels_->ranges(here, modules, kAroundMarker_px,
                                   static_cast<float>(pad) + kAroundMarker_px + 1.0F, count);
    }
    if (y >= 0 && y < window.height) {
      rows_->Keep(y, map);
      RowRange& range = (*ranges)[y];
      range = {0, window.width};
      if (!everywhere) {
        range.begin = std::clamp(of_marker.near.begin - pad, 0, window.width);
        range.end = std::clamp(of_marker.near.end - pad, range.begin, window.width);
      }
    }
    SampleRow(here, table, taps, of_marker.far, count, y + pad);
    if (y < pad) continue;
    WriteRow(taps, y - pad, (*ranges)[y - pad], window.width, image);
  }
}

void MarkerRaster::SampleRow(const MapRow& map, const NodeTable& table, const BlurTaps& taps,
                             RowRange sampled, int count, int index) {
  const int per_pixel = taps.per_pixel, pad = taps.pixels / 2;
  const int width = count - 2 * pad, row = rows_->stride();
  // White where nothing is sampled.
  const int begin = sampled.begin, end = sampled.end;
  const int drawn = std::max(0, end - begin);
  if (drawn > 0) {
    kernels_->sample({map.column + begin, map.row + begin, map.column_x + begin,
                      map.column_y + begin, map.row_x + begin, map.row_y + begin},
                     table, per_pixel, drawn, row, rows_->samples(0) + begin);
  }
  // … as far as the blur reaches.
  const int white_begin = std::max(0, begin - 2 * pad), white_end = std::min(count, end + 2 * pad);
  for (int s = 0; s < per_pixel * per_pixel && drawn > 0; ++s) {
    float* samples = rows_->samples(s);
    std::fill(samples + white_begin, samples + begin, 1.0F);
    std::fill(samples + end, samples + white_end, 1.0F);
  }
  for (int j = 0; j < per_pixel; ++j) {
    float* const blurred = rows_->blurred(index * per_pixel + j);
    float* const blurred_x = rows_->blurred_x(index * per_pixel + j);
    if (drawn == 0) {
      std::fill_n(blurred, width, 1.0F);
      std::fill_n(blurred_x, width, 0.0F);
      continue;
    }
    const int first = std::max(0, begin - 2 * pad), last = std::min(width, end);
    std::fill_n(blurred, first, 1.0F);
    std::fill_n(blurred_x, first, 0.0F);
    kernels_->along_row(rows_->samples(j * per_pixel) + first, row, taps, last - first,
                        blurred + first, blurred_x + first);
    std::fill(blurred + last, blurred + width, 1.0F);
    std::fill(blurred_x + last, blurred_x + width, 0.0F);
  }
}

void MarkerRaster::WriteRow(const BlurTaps& taps, int y, RowRange range, int width,
                            PredictedImage* image) {
  const std::size_t at = static_cast<std::size_t>(y) * width;
  // Wide enough for a whole vector, if the window is.
  if (range.end > range.begin) {
    range.end = std::min(width, std::max(range.end, range.begin + kRowSlack));
    range.begin = std::max(0, std::min(range.begin, range.end - kRowSlack));
    rows_->Gather(y, range.begin);
    kernels_->along_column(rows_->rows(), rows_->rows_x(), taps, range.end - range.begin,
                           &image->white[at + range.begin], &image->white_x[at + range.begin],
                           &image->white_y[at + range.begin]);
  }
  const auto fill = [&](std::vector<float>* values, float value) {
    std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(at), range.begin, value);
    std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(at) + range.end, width - range.end,
                value);
  };
  fill(&image->white, 1.0F);
  fill(&image->white_x, 0.0F);
  fill(&image->white_y, 0.0F);
}

}  // namespace pleinair::tracker
