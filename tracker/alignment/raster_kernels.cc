#include "tracker/alignment/raster_kernels.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

void Map(const RayRow& rays, const float m[9], int count, const MapRow& out) {
  const float *qx = rays.x, *qy = rays.y;
  const std::ptrdiff_t stride = rays.stride;
  for (int x = 0; x < count; ++x) {
    const float ix = qx[x] - rays.origin_x, iy = qy[x] - rays.origin_y;
    const float w = 1.0F / (m[6] * ix + m[7] * iy + m[8]);
    const float column = (m[0] * ix + m[1] * iy + m[2]) * w;
    const float row = (m[3] * ix + m[4] * iy + m[5]) * w;
    // Derivatives by the undistorted pixel, then by the window's pixel.
    const float cx = (m[0] - m[6] * column) * w, cy = (m[1] - m[7] * column) * w;
    const float rx = (m[3] - m[6] * row) * w, ry = (m[4] - m[7] * row) * w;
    const float x_x = 0.5F * (qx[x + 1] - qx[x - 1]), y_x = 0.5F * (qy[x + 1] - qy[x - 1]);
    const float x_y = 0.5F * (qx[x + stride] - qx[x - stride]);
    const float y_y = 0.5F * (qy[x + stride] - qy[x - stride]);
    out.column[x] = column;
    out.row[x] = row;
    out.column_x[x] = cx * x_x + cy * y_x;
    out.column_y[x] = cx * x_y + cy * y_y;
    out.row_x[x] = rx * x_x + ry * y_x;
    out.row_y[x] = rx * x_y + ry * y_y;
  }
}

RowRanges Ranges(const MapRow& map, float modules, float near_px, float far_px, int count) {
  const auto range_of = [&](float reach_px) {
    RowRange range{count, 0};
    for (int x = 0; x < count; ++x) {
      const auto near = [&](float value, float at_x, float at_y) {
        const float far = reach_px * (std::fabs(at_x) + std::fabs(at_y));
        return value > -far && value < modules + far;
      };
      if (!near(map.column[x], map.column_x[x], map.column_y[x]) ||
          !near(map.row[x], map.row_x[x], map.row_y[x])) {
        continue;
      }
      range.begin = std::min(range.begin, x);
      range.end = x + 1;
    }
    return range.begin < range.end ? range : RowRange{};
  };
  return {range_of(near_px), range_of(far_px)};
}

/// Pixels without a ray are mapped to the marker's first corner.
float Finite(float value) { return value == value ? value : 0.0F; }

void Sample(const MapRow& map, const NodeTable& table, int per_pixel, int count,
            std::ptrdiff_t stride, float* out) {
  const float bin = 1.0F / static_cast<float>(per_pixel);
  const float last = static_cast<float>(table.nodes - 1);
  const bool near_centre = per_pixel <= kMaxSamplesNearCentre;
  const float steepest = near_centre ? kMaxSlopeNearCentre : kMaxModule;
  const auto slope = [&](float value) { return std::clamp(Finite(value), -steepest, steepest); };
  for (int x = 0; x < count; ++x) {
    // The outermost modules are extended beyond the marker.
    const float column = std::clamp(Finite(map.column[x]), 0.0F, last);
    const float row = std::clamp(Finite(map.row[x]), 0.0F, last);
    const float column_x = slope(map.column_x[x]), column_y = slope(map.column_y[x]);
    const float row_x = slope(map.row_x[x]), row_y = slope(map.row_y[x]);
    // The sample's footprint is a parallelogram; it is replaced by a box of the same variance along
    // each axis.
    const float inverse_c =
        1.0F / std::sqrt(std::max((column_x * column_x + column_y * column_y) * bin * bin,
                                  kMinBox2_modules2));
    const float inverse_r =
        1.0F / std::sqrt(std::max((row_x * row_x + row_y * row_y) * bin * bin, kMinBox2_modules2));
    const float centre_c = std::nearbyint(column), centre_r = std::nearbyint(row);
    for (int j = 0; j < per_pixel; ++j) {
      const float dy = (static_cast<float>(j) + 0.5F) * bin - 0.5F;
      for (int i = 0; i < per_pixel; ++i) {
        const float dx = (static_cast<float>(i) + 0.5F) * bin - 0.5F;
        // From the node nearest to the pixel's centre; its modules contain those of the adjacent
        // nodes.
        float c = column - centre_c + column_x * dx + column_y * dy;
        float r = row - centre_r + row_x * dx + row_y * dy;
        float node_c = centre_c, node_r = centre_r;
        int shift = 5;
        if (near_centre) {
          const float right = std::nearbyint(c), down = std::nearbyint(r);
          shift += 4 * static_cast<int>(down) + static_cast<int>(right);
          c -= right;
          r -= down;
        } else {
          c = std::clamp(c + centre_c, 0.0F, last);
          r = std::clamp(r + centre_r, 0.0F, last);
          node_c = std::nearbyint(c);
          node_r = std::nearbyint(r);
          c -= node_c;
          r -= node_r;
        }
        const std::uint32_t around =
            table.around[static_cast<int>(node_r) * table.nodes + static_cast<int>(node_c)] >>
            shift;
        const auto module = [&](int bit) { return static_cast<float>(around >> bit & 1U); };
        const float s = std::clamp(c * inverse_c + 0.5F, 0.0F, 1.0F);
        const float t = std::clamp(r * inverse_r + 0.5F, 0.0F, 1.0F);
        const float top = module(0) * (1.0F - s) + module(1) * s;
        const float bottom = module(4) * (1.0F - s) + module(5) * s;
        out[(j * per_pixel + i) * stride + x] = top + (bottom - top) * t;
      }
    }
  }
}

void AlongRow(const float* in, std::ptrdiff_t stride, const BlurTaps& taps, int count,
              float* blurred, float* blurred_x) {
  for (int x = 0; x < count; ++x) {
    float sum = 0.0F, slope = 0.0F;
    for (int p = 0; p < taps.pixels; ++p) {
      for (int i = 0; i < taps.per_pixel; ++i) {
        const float value = in[i * stride + x + p];
        sum += taps.weight[p * taps.per_pixel + i] * value;
        slope += taps.slope[p * taps.per_pixel + i] * value;
      }
    }
    blurred[x] = sum;
    blurred_x[x] = slope;
  }
}

void AlongColumn(const float* const* rows, const float* const* rows_x, const BlurTaps& taps,
                 int count, float* white, float* white_x, float* white_y) {
  const int all = taps.pixels * taps.per_pixel;
  for (int x = 0; x < count; ++x) {
    float sum = 0.0F, sum_x = 0.0F, sum_y = 0.0F;
    for (int k = 0; k < all; ++k) {
      sum += taps.weight[k] * rows[k][x];
      sum_x += taps.weight[k] * rows_x[k][x];
      sum_y += taps.slope[k] * rows[k][x];
    }
    white[x] = sum;
    white_x[x] = sum_x;
    white_y[x] = sum_y;
  }
}

}  // namespace

const RasterKernels& ScalarRasterKernels() {
  static const RasterKernels kKernels{&Map, &Ranges, &Sample, &AlongRow, &AlongColumn};
  return kKernels;
}

}  // namespace pleinair::tracker
