#include "tracker/alignment/print_raster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::tracker {
namespace {

constexpr double kKernelSigmas = 3.0;
constexpr double kSharpestBlur_px = 0.12;

/// ∫ of the normal distribution function Φ(x/σ) up to x.
double PrimitiveOfNormal(double x, double sigma) {
  const double z = x / sigma;
  const double below = 0.5 * std::erfc(-z / std::numbers::sqrt2);
  const double density =
      std::exp(-0.5 * z * z) * (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
  return x * below + sigma * density;
}

/// A pixel's square, one wide, blurred by a Gaussian.
double BlurredBox(double x, double sigma) {
  const double scale = 1.0 / (sigma * std::numbers::sqrt2);
  return 0.5 * (std::erfc(-(x + 0.5) * scale) - std::erfc(-(x - 0.5) * scale));
}

}  // namespace

void LookUpRays(const LensGrid& lens, const PixelWindow& window, WindowRays* rays) {
  rays->window = window;
  const int width = window.width + 2 * kWindowBorder, height = window.height + 2 * kWindowBorder;
  rays->x.resize(static_cast<std::size_t>(width) * height);
  rays->y.resize(rays->x.size());
  std::size_t at = 0;
  for (int j = 0; j < height; ++j) {
    const double y = window.Full(window.y0 + j - kWindowBorder);
    for (int i = 0; i < width; ++i, ++at) {
      const Vec2 ideal = lens.Ideal(window.Full(window.x0 + i - kWindowBorder), y);
      rays->x[at] = static_cast<float>(ideal.x);
      rays->y[at] = static_cast<float>(ideal.y);
    }
  }
}

void PrintRaster::SetKernel(double blur_px, int per_pixel, int* pad) {
  // The box of each sample and the bins of the kernel blur as well: their variances are taken off.
  const double bin = 1.0 / per_pixel;
  const double variance =
      std::max(blur_px * blur_px - 2.0 * bin * bin / 12.0, kSharpestBlur_px * kSharpestBlur_px);
  const double sigma = std::sqrt(variance);
  *pad = std::min(kWindowBorder - 1, static_cast<int>(std::ceil(kKernelSigmas * sigma)));
  const int taps = (2 * *pad + 1) * per_pixel;
  kernel_.resize(taps);
  kernel_slope_.resize(taps);
  double sum = 0.0;
  for (int k = 0; k < taps; ++k) {
    // From the pixel's centre to the sample's.
    const double t = (k + 0.5) * bin - 0.5 - *pad;
    const double low = t - 0.5 * bin, high = t + 0.5 * bin;
    const double weight = PrimitiveOfNormal(high + 0.5, sigma) -
                          PrimitiveOfNormal(high - 0.5, sigma) -
                          PrimitiveOfNormal(low + 0.5, sigma) + PrimitiveOfNormal(low - 0.5, sigma);
    kernel_[k] = static_cast<float>(weight);
    // The picture is ∫ print(p + t) K(t) dt, so that its slope is -∫ print(p + t) K'(t) dt.
    kernel_slope_[k] = static_cast<float>(BlurredBox(low, sigma) - BlurredBox(high, sigma));
    sum += weight;
  }
  for (float& weight : kernel_) weight = static_cast<float>(weight / sum);
}

void PrintRaster::SampleRows(const PrintPattern& pattern, const Mat3& m, const WindowRays& rays,
                             int pad, int per_pixel) {
  const PixelWindow& window = rays.window;
  const int nodes = pattern.modules + 1;
  corners_.resize(static_cast<std::size_t>(nodes) * nodes);
  for (int j = 0; j < nodes; ++j) {
    for (int i = 0; i < nodes; ++i) {
      const int left = std::max(i - 1, 0), right = std::min(i, pattern.modules - 1);
      const int top = std::max(j - 1, 0), bottom = std::min(j, pattern.modules - 1);
      const auto white = [&](int x, int y) { return pattern.white[y * pattern.modules + x]; };
      corners_[j * nodes + i] =
          static_cast<std::uint8_t>(white(left, top) | white(right, top) << 1 |
                                    white(left, bottom) << 2 | white(right, bottom) << 3);
    }
  }
  const int stride = window.width + 2 * kWindowBorder;
  const int width = (window.width + 2 * pad) * per_pixel;
  samples_.resize(static_cast<std::size_t>(width) * (window.height + 2 * pad) * per_pixel);
  const float bin = 1.0F / static_cast<float>(per_pixel);
  const float last = static_cast<float>(nodes - 1);
  const float m0 = static_cast<float>(m.m[0]), m1 = static_cast<float>(m.m[1]),
              m2 = static_cast<float>(m.m[2]), m3 = static_cast<float>(m.m[3]),
              m4 = static_cast<float>(m.m[4]), m5 = static_cast<float>(m.m[5]),
              m6 = static_cast<float>(m.m[6]), m7 = static_cast<float>(m.m[7]),
              m8 = static_cast<float>(m.m[8]);
  for (int y = -pad; y < window.height + pad; ++y) {
    const std::size_t from = static_cast<std::size_t>(y + kWindowBorder) * stride + kWindowBorder;
    for (int x = -pad; x < window.width + pad; ++x) {
      const std::size_t at = from + x;
      const float qx = rays.x[at], qy = rays.y[at];
      const float w = 1.0F / (m6 * qx + m7 * qy + m8);
      const float column = (m0 * qx + m1 * qy + m2) * w;
      const float row = (m3 * qx + m4 * qy + m5) * w;
      // Derivatives by the ideal pixel, then by the window's.
      const float cx = (m0 - m6 * column) * w, cy = (m1 - m7 * column) * w;
      const float rx = (m3 - m6 * row) * w, ry = (m4 - m7 * row) * w;
      const float qx_x = 0.5F * (rays.x[at + 1] - rays.x[at - 1]);
      const float qy_x = 0.5F * (rays.y[at + 1] - rays.y[at - 1]);
      const float qx_y = 0.5F * (rays.x[at + stride] - rays.x[at - stride]);
      const float qy_y = 0.5F * (rays.y[at + stride] - rays.y[at - stride]);
      const float column_x = cx * qx_x + cy * qy_x, column_y = cx * qx_y + cy * qy_y;
      const float row_x = rx * qx_x + ry * qy_x, row_y = rx * qx_y + ry * qy_y;
      // The sample's footprint is a parallelogram; a box of the same variance along each axis.
      const float box_c =
          std::max(1e-3F, std::sqrt(column_x * column_x + column_y * column_y) * bin);
      const float box_r = std::max(1e-3F, std::sqrt(row_x * row_x + row_y * row_y) * bin);
      const float inverse_c = 1.0F / box_c, inverse_r = 1.0F / box_r;
      float* out = &samples_[static_cast<std::size_t>(y + pad) * per_pixel * width +
                             static_cast<std::size_t>(x + pad) * per_pixel];
      for (int j = 0; j < per_pixel; ++j, out += width) {
        const float dy = (static_cast<float>(j) + 0.5F) * bin - 0.5F;
        for (int i = 0; i < per_pixel; ++i) {
          const float dx = (static_cast<float>(i) + 0.5F) * bin - 0.5F;
          float c = column + column_x * dx + column_y * dy;
          float r = row + row_x * dx + row_y * dy;
          // Beyond the print its outermost modules go on; so do pixels that see nothing (not a
          // number: the comparisons then choose 0).
          c = c > 0.0F ? (c < last ? c : last) : 0.0F;
          r = r > 0.0F ? (r < last ? r : last) : 0.0F;
          const int ci = static_cast<int>(c + 0.5F), ri = static_cast<int>(r + 0.5F);
          const unsigned around = corners_[ri * nodes + ci];
          if (around == 0U || around == 15U) {
            out[i] = around == 0U ? 0.0F : 1.0F;
            continue;
          }
          const float s = std::clamp((c - static_cast<float>(ci)) * inverse_c + 0.5F, 0.0F, 1.0F);
          const float t = std::clamp((r - static_cast<float>(ri)) * inverse_r + 0.5F, 0.0F, 1.0F);
          const float tl = static_cast<float>(around & 1U),
                      tr = static_cast<float>(around >> 1 & 1U);
          const float bl = static_cast<float>(around >> 2 & 1U),
                      br = static_cast<float>(around >> 3);
          const float top = tl + (tr - tl) * s, bottom = bl + (br - bl) * s;
          out[i] = top + (bottom - top) * t;
        }
      }
    }
  }
}

void PrintRaster::Render(const PrintPattern& pattern, const Mat3& modules_from_ideal,
                         const WindowRays& rays, double blur_px, PrintMap* map,
                         PrintPicture* picture) {
  const PixelWindow& window = rays.window;
  const std::size_t pixels = window.size();
  for (auto* values : {&map->column, &map->row, &map->column_x, &map->column_y, &map->row_x,
                       &map->row_y, &picture->white, &picture->white_x, &picture->white_y}) {
    values->resize(pixels);
  }
  const int stride = window.width + 2 * kWindowBorder;
  const Mat3& m = modules_from_ideal;
  float finest = 1.0F;  // Modules per pixel, the most there are.
  for (int y = 0; y < window.height; ++y) {
    const std::size_t from = static_cast<std::size_t>(y + kWindowBorder) * stride + kWindowBorder;
    for (int x = 0; x < window.width; ++x) {
      const std::size_t at = from + x, to = static_cast<std::size_t>(y) * window.width + x;
      const double qx = rays.x[at], qy = rays.y[at];
      const double w = 1.0 / (m.m[6] * qx + m.m[7] * qy + m.m[8]);
      const double column = (m.m[0] * qx + m.m[1] * qy + m.m[2]) * w;
      const double row = (m.m[3] * qx + m.m[4] * qy + m.m[5]) * w;
      const double cx = (m.m[0] - m.m[6] * column) * w, cy = (m.m[1] - m.m[7] * column) * w;
      const double rx = (m.m[3] - m.m[6] * row) * w, ry = (m.m[4] - m.m[7] * row) * w;
      const double qx_x = 0.5 * (rays.x[at + 1] - rays.x[at - 1]);
      const double qy_x = 0.5 * (rays.y[at + 1] - rays.y[at - 1]);
      const double qx_y = 0.5 * (rays.x[at + stride] - rays.x[at - stride]);
      const double qy_y = 0.5 * (rays.y[at + stride] - rays.y[at - stride]);
      map->column[to] = static_cast<float>(column);
      map->row[to] = static_cast<float>(row);
      map->column_x[to] = static_cast<float>(cx * qx_x + cy * qy_x);
      map->column_y[to] = static_cast<float>(cx * qx_y + cy * qy_y);
      map->row_x[to] = static_cast<float>(rx * qx_x + ry * qy_x);
      map->row_y[to] = static_cast<float>(rx * qx_y + ry * qy_y);
      if (column > 0 && column < pattern.modules && row > 0 && row < pattern.modules) {
        finest = std::max(finest, std::max(std::hypot(map->column_x[to], map->column_y[to]),
                                           std::hypot(map->row_x[to], map->row_y[to])));
      }
    }
  }
  const int per_pixel = std::clamp(static_cast<int>(std::ceil(finest)), 2, 6);
  int pad = 0;
  SetKernel(blur_px, per_pixel, &pad);
  SampleRows(pattern, modules_from_ideal, rays, pad, per_pixel);

  const int taps = static_cast<int>(kernel_.size());
  const int rows = (window.height + 2 * pad) * per_pixel;
  const int width = (window.width + 2 * pad) * per_pixel;
  blurred_.resize(static_cast<std::size_t>(rows) * window.width);
  blurred_x_.resize(blurred_.size());
  for (int j = 0; j < rows; ++j) {
    const float* line = &samples_[static_cast<std::size_t>(j) * width];
    for (int x = 0; x < window.width; ++x) {
      const float* in = line + static_cast<std::size_t>(x) * per_pixel;
      float sum = 0.0F, slope = 0.0F;
      for (int k = 0; k < taps; ++k) {
        sum += kernel_[k] * in[k];
        slope += kernel_slope_[k] * in[k];
      }
      blurred_[static_cast<std::size_t>(j) * window.width + x] = sum;
      blurred_x_[static_cast<std::size_t>(j) * window.width + x] = slope;
    }
  }
  for (int y = 0; y < window.height; ++y) {
    float* white = &picture->white[static_cast<std::size_t>(y) * window.width];
    float* white_x = &picture->white_x[static_cast<std::size_t>(y) * window.width];
    float* white_y = &picture->white_y[static_cast<std::size_t>(y) * window.width];
    std::fill(white, white + window.width, 0.0F);
    std::fill(white_x, white_x + window.width, 0.0F);
    std::fill(white_y, white_y + window.width, 0.0F);
    for (int k = 0; k < taps; ++k) {
      const std::size_t from = static_cast<std::size_t>(y * per_pixel + k) * window.width;
      const float weight = kernel_[k], slope = kernel_slope_[k];
      const float* in = &blurred_[from];
      const float* in_x = &blurred_x_[from];
      for (int x = 0; x < window.width; ++x) {
        white[x] += weight * in[x];
        white_x[x] += weight * in_x[x];
        white_y[x] += slope * in[x];
      }
    }
  }
}

}  // namespace pleinair::tracker
