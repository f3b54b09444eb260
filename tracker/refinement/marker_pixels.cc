#include "tracker/refinement/marker_pixels.h"

#include <algorithm>
#include <cmath>

#include "tracker/pose/homography.h"
#include "tracker/refinement/marker_coverage.h"

namespace pleinair::tracker {
namespace {

/// Maximum number of pixels near edges, and of others; more cost time without a gain.
constexpr std::size_t kMaxEdgePixels = 6000, kMaxFlatPixels = 2000;

}  // namespace

Vec2 PixelOfMarkerPoint(const CameraModel& camera, const Mat3& rays_from_marker, Vec2 marker) {
  const Vec2 ray = Apply(rays_from_marker, marker);
  return ProjectToPixel(camera, Point<Camera>{{ray.x, ray.y, 1.0}});
}

MarkerPixels GatherMarkerPixels(const CameraModel& camera, const MarkerPattern& pattern,
                                ImageView<const std::uint8_t> grey, const Mat3& rays_from_marker) {
  const double extent = pattern.Extent();
  Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
  for (const Vec2 corner : kSquareCorners) {
    const Vec2 pixel = PixelOfMarkerPoint(camera, rays_from_marker, corner * extent);
    low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
    high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
  }
  const int left = std::max(0, static_cast<int>(std::floor(low.x)));
  const int top = std::max(0, static_cast<int>(std::floor(low.y)));
  const int right = std::min(grey.width() - 1, static_cast<int>(std::ceil(high.x)));
  const int bottom = std::min(grey.height() - 1, static_cast<int>(std::ceil(high.y)));
  const Mat3 marker_from_rays = Adjugate(rays_from_marker);
  // Bounds the work on very large markers: a coarser raster of pixels, the same in x and y.
  const double area_px = std::max(0.0, high.x - low.x) * std::max(0.0, high.y - low.y);
  const int stride = std::max(1, static_cast<int>(std::sqrt(area_px / 250'000.0)));

  MarkerPixels gathered;
  std::vector<MarkerPixel> edge, flat;
  for (int y = top; y <= bottom; y += stride) {
    for (int x = left; x <= right; x += stride) {
      MarkerPixel pixel{.x = x,
                        .y = y,
                        .ray = UndistortPixel(camera, {1.0 * x, 1.0 * y}),
                        .ray_d_x = {},
                        .ray_d_y = {},
                        .code = 1.0 * grey(x, y)};
      const Vec2 marker = Apply(marker_from_rays, pixel.ray);
      const double beyond = std::max(std::fabs(marker.x), std::fabs(marker.y));
      if (!(beyond <= extent)) continue;
      pixel.ray_d_x =
          (UndistortPixel(camera, {x + 0.5, 1.0 * y}) - UndistortPixel(camera, {x - 0.5, 1.0 * y}));
      pixel.ray_d_y =
          (UndistortPixel(camera, {1.0 * x, y + 0.5}) - UndistortPixel(camera, {1.0 * x, y - 0.5}));
      const Vec2 d_x = Apply(marker_from_rays, pixel.ray + pixel.ray_d_x) - marker;
      const Vec2 d_y = Apply(marker_from_rays, pixel.ray + pixel.ray_d_y) - marker;
      // The surface beyond the quiet zone is unknown: it must not contribute to the pixel.
      const double footprint = std::max(std::hypot(d_x.x, d_y.x), std::hypot(d_x.y, d_y.y));
      const double module = 2.0 / pattern.edge_modules;
      if (beyond > std::max(extent - 0.8 * footprint, 1.0 + std::min(0.5 * footprint, module))) {
        continue;
      }
      const Coverage coverage = CoverageOfPixel(pattern, marker, d_x, d_y, kInitialBlur_px);
      (coverage.uniform ? flat : edge).push_back(pixel);
    }
  }
  const auto keep = [&](const std::vector<MarkerPixel>& from, std::size_t most) {
    const std::size_t step = from.size() / most + 1;
    for (std::size_t i = 0; i < from.size(); i += step) gathered.pixels.push_back(from[i]);
  };
  keep(edge, kMaxEdgePixels);
  keep(flat, kMaxFlatPixels);

  int inside = 0, all = 0;
  for (int j = 0; j < pattern.modules; ++j) {
    for (int i = 0; i < pattern.modules; ++i, ++all) {
      const Vec2 pixel = PixelOfMarkerPoint(camera, rays_from_marker,
                                            {extent * (2.0 * (i + 0.5) / pattern.modules - 1.0),
                                             extent * (2.0 * (j + 0.5) / pattern.modules - 1.0)});
      inside += IsInImage(grey, pixel) ? 1 : 0;
    }
  }
  gathered.observed_share = static_cast<double>(inside) / all;
  return gathered;
}

}  // namespace pleinair::tracker
