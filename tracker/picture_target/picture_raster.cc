#include "tracker/picture_target/picture_raster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracker/alignment/raster_kernels.h"
#include "tracker/alignment/raster_rows.h"
#include "tracker/picture_target/picture_target.h"

namespace pleinair::tracker {
namespace {

constexpr double kKernelSigmas = 3.0;
constexpr double kSharpestBlur_px = 0.12;
/// From this blur on one sample per pixel suffices if texels are no smaller than pixels.
constexpr double kSmoothBlur_px = 1.0;
constexpr double kMaxSamples = 5.0;  ///< Maximum, along a pixel's side.
constexpr float kAround_px = 2.0F;   ///< Predicted beyond the target's edge.
constexpr int kProbes = 6;           ///< Along each side of the window.

/// A pixel's square, one wide, blurred by a Gaussian.
double BlurredBox(double x, double sigma) {
  const double scale = 1.0 / (sigma * std::numbers::sqrt2);
  return 0.5 * (std::erfc(-(x + 0.5) * scale) - std::erfc(-(x - 0.5) * scale));
}

/// Interpolates `level` at each pixel's `per_pixel`² samples: out[j][i][x], rows `stride` apart.
void Sample(const MapRow& map, const Image<float>& level, Vec2 texels_per_unit, int per_pixel,
            int count, std::ptrdiff_t stride, float* out) {
  const float bin = 1.0F / static_cast<float>(per_pixel);
  const auto scale_x = static_cast<float>(texels_per_unit.x);
  const auto scale_y = static_cast<float>(texels_per_unit.y);
  const int width = level.width();
  const auto last_x = static_cast<float>(width - 1) - 1e-3F;
  const auto last_y = static_cast<float>(level.height() - 1) - 1e-3F;
  const float* texels = level.data();
  for (int j = 0; j < per_pixel; ++j) {
    const float dy = (static_cast<float>(j) + 0.5F) * bin - 0.5F;
    for (int i = 0; i < per_pixel; ++i) {
      const float dx = (static_cast<float>(i) + 0.5F) * bin - 0.5F;
      float* to = out + (j * per_pixel + i) * stride;
      for (int x = 0; x < count; ++x) {
        const float tx =
            scale_x * (map.column[x] + map.column_x[x] * dx + map.column_y[x] * dy) - 0.5F;
        const float ty = scale_y * (map.row[x] + map.row_x[x] * dx + map.row_y[x] * dy) - 0.5F;
        // Beyond the target its outermost texels continue; NaN samples the first one.
        const float cx = std::min(tx > 0.0F ? tx : 0.0F, last_x);
        const float cy = std::min(ty > 0.0F ? ty : 0.0F, last_y);
        const int ix = static_cast<int>(cx), iy = static_cast<int>(cy);
        const float s = cx - static_cast<float>(ix), t = cy - static_cast<float>(iy);
        const float* at = texels + static_cast<std::ptrdiff_t>(iy) * width + ix;
        const float top = at[0] + (at[1] - at[0]) * s;
        const float bottom = at[width] + (at[width + 1] - at[width]) * s;
        to[x] = top + (bottom - top) * t;
      }
    }
  }
}

}  // namespace

PictureRaster::PictureRaster()
    : kernels_(&SimdRasterKernels()), rows_(std::make_unique<RasterRows>()) {}
PictureRaster::~PictureRaster() = default;
PictureRaster::PictureRaster(PictureRaster&&) noexcept = default;
PictureRaster& PictureRaster::operator=(PictureRaster&&) noexcept = default;

void PictureRaster::SetKernel(double blur_px, int per_pixel, int* pad) {
  const double bin = 1.0 / per_pixel;
  const double sigma = std::max(blur_px, kSharpestBlur_px);
  *pad = std::min(kWindowBorder - 1, static_cast<int>(std::ceil(kKernelSigmas * sigma)));
  const int taps = (2 * *pad + 1) * per_pixel;
  kernel_.resize(taps);
  kernel_slope_.resize(taps);
  double sum = 0.0;
  for (int k = 0; k < taps; ++k) {
    // From the pixel's centre to the sample's.
    const double t = (k + 0.5) * bin - 0.5 - *pad;
    const double weight = bin * BlurredBox(t, sigma);
    kernel_[k] = static_cast<float>(weight);
    // The image is ∫ marker(p + t) K(t) dt, so its slope is -∫ marker(p + t) K'(t) dt.
    kernel_slope_[k] =
        static_cast<float>(BlurredBox(t - 0.5 * bin, sigma) - BlurredBox(t + 0.5 * bin, sigma));
    sum += weight;
  }
  for (float& weight : kernel_) weight = static_cast<float>(weight / sum);
}

PictureRaster::Sampling PictureRaster::ChooseSampling(const PicturePyramid& pyramid,
                                                      const Mat3& target_from_undistorted,
                                                      const WindowRays& rays, double blur_px) {
  const PixelWindow& window = rays.window;
  const int stride = window.width + 2 * kWindowBorder;
  const Mat3& m = target_from_undistorted;
  const double per_x = pyramid.width() / kTargetSide, per_y = pyramid.height() / kTargetSide;
  double narrowest = 0.0,
         widest = 0.0;  // Texels per pixel, in the directions of the fewest and of the most.
  int probes = 0;
  for (int j = 0; j <= kProbes; ++j) {
    for (int i = 0; i <= kProbes; ++i) {
      const int x = (window.width - 1) * i / kProbes, y = (window.height - 1) * j / kProbes;
      const std::size_t at =
          static_cast<std::size_t>(y + kWindowBorder) * stride + kWindowBorder + x;
      const Vec3 point = m * Vec3{rays.x[at], rays.y[at], 1.0};
      const double w = 1.0 / point.z, u = point.x * w, v = point.y * w;
      if (!(u > 0 && u < kTargetSide && v > 0 && v < kTargetSide)) continue;
      const double a = per_x * (m.m[0] - m.m[6] * u) * w, b = per_x * (m.m[1] - m.m[7] * u) * w;
      const double c = per_y * (m.m[3] - m.m[6] * v) * w, d = per_y * (m.m[4] - m.m[7] * v) * w;
      // Singular values of the Jacobian from its trace and determinant.
      const double squares = a * a + b * b + c * c + d * d, area = std::fabs(a * d - b * c);
      const double sum = std::sqrt(squares + 2.0 * area);
      const double difference = std::sqrt(std::max(0.0, squares - 2.0 * area));
      narrowest += std::log2(std::max(1e-3, 0.5 * (sum - difference) * window.Scale()));
      widest = std::max(widest, 0.5 * (sum + difference) * window.Scale());
      ++probes;
    }
  }
  Sampling sampling;
  if (probes == 0) return sampling;
  const int last = pyramid.levels() - 1;
  sampling.level = static_cast<int>(std::clamp(std::floor(narrowest / probes), 0.0, 1.0 * last));
  // At large tilts use a coarser level rather than ever more samples.
  while (sampling.level < last && widest / (1 << sampling.level) > kMaxSamples) ++sampling.level;
  const double finest = widest / (1 << sampling.level);
  const bool smooth = finest <= 1.0 && blur_px >= kSmoothBlur_px;
  sampling.per_pixel =
      smooth ? 1 : static_cast<int>(std::ceil(std::clamp(finest, 2.0, kMaxSamples)));
  return sampling;
}

void PictureRaster::Render(const PicturePyramid& pyramid, const Mat3& target_from_undistorted,
                           const WindowRays& rays, double blur_px, PlaneMap* map,
                           PredictedImage* picture, std::vector<RowRange>* ranges) {
  const PixelWindow& window = rays.window;
  RasterRows::Resize(window, map, picture, ranges);
  if (window.empty()) return;
  const Sampling sampling = ChooseSampling(pyramid, target_from_undistorted, rays, blur_px);
  const Image<float>& level = pyramid.level(sampling.level);
  const double per_level = 1.0 / (kTargetSide * (1 << sampling.level));
  const Vec2 texels_per_unit{pyramid.width() * per_level, pyramid.height() * per_level};
  const int per_pixel = sampling.per_pixel;
  int pad = 0;
  SetKernel(blur_px, per_pixel, &pad);
  const BlurTaps taps{kernel_.data(), kernel_slope_.data(), per_pixel, 2 * pad + 1};
  rows_->Start(target_from_undistorted, rays, pad, per_pixel);
  const int count = rows_->count();
  constexpr auto kSide = static_cast<float>(kTargetSide);

  for (int y = -pad; y < window.height + pad; ++y) {
    const MapRow& here = rows_->Evaluate(*kernels_, rays, y);
    const RowRanges of_target = kernels_->ranges(
        here, kSide, kAround_px, static_cast<float>(pad) + kAround_px + 1.0F, count);
    if (y >= 0 && y < window.height) {
      rows_->Keep(y, map);
      RowRange& range = (*ranges)[y];
      range.begin = std::clamp(of_target.near.begin - pad, 0, window.width);
      range.end = std::clamp(of_target.near.end - pad, range.begin, window.width);
    }
    const RowRange sampled = of_target.far;
    const int begin = sampled.begin, drawn = sampled.end - sampled.begin;
    if (drawn > 0) {
      Sample({here.column + begin, here.row + begin, here.column_x + begin, here.column_y + begin,
              here.row_x + begin, here.row_y + begin},
             level, texels_per_unit, per_pixel, drawn, rows_->stride(), rows_->samples(0) + begin);
    }
    for (int s = 0; s < per_pixel * per_pixel; ++s) {
      float* samples = rows_->samples(s);
      std::fill(samples, samples + begin, 0.0F);
      std::fill(samples + begin + drawn, samples + count, 0.0F);
    }
    for (int j = 0; j < per_pixel; ++j) {
      const int to = (y + pad) * per_pixel + j;
      kernels_->along_row(rows_->samples(j * per_pixel), rows_->stride(), taps, window.width,
                          rows_->blurred(to), rows_->blurred_x(to));
    }
    if (y < pad) continue;
    const int out = y - pad;
    rows_->Gather(out, 0);
    const std::size_t at = static_cast<std::size_t>(out) * window.width;
    kernels_->along_column(rows_->rows(), rows_->rows_x(), taps, window.width, &picture->white[at],
                           &picture->white_x[at], &picture->white_y[at]);
  }
}

}  // namespace pleinair::tracker
