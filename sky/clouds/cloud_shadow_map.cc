#include "sky/clouds/cloud_shadow_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/bilinear.h"
#include "base/parallel_for.h"
#include "sky/clouds/sun_disc_rays.h"

namespace pleinair::clouds {
namespace {

/// Frame across the rays of a sun above the horizon.
struct AcrossRays {
  Vec3 x, y, sun;

  explicit AcrossRays(Direction<World> to_sun) : sun(to_sun.xyz) {
    x = sun.z < 0.999 ? Normalized(Cross({0.0, 0.0, 1.0}, sun)) : Vec3{1.0, 0.0, 0.0};
    y = Cross(sun, x);
    x = Cross(y, sun);
  }
  /// Where the ray through a place across the rays meets level ground at height 0.
  Vec3 OnGround(double at_x, double at_y) const {
    const Vec3 across = x * at_x + y * at_y;
    return across - sun * (across.z / sun.z);
  }
};

/// Optical depth of one layer towards the sun, on a grid across the rays.
class DepthGrid {
 public:
  DepthGrid(const CloudField& field, const AcrossRays& rays, const CloudShadowMap& map,
            double seconds) {
    const CloudLayer& layer = field.layer();
    radius_m_ = (layer.base_m + 0.5 * layer.thickness_m) / rays.sun.z * sky::kSolarRadiusAt1Au;
    // Eight texels across the disc resolve what its mean leaves of an edge.
    cell_m_ = std::max(map.texel_m, radius_m_ / 4.0);
    first_x_m_ = map.first_x_m - radius_m_ - cell_m_;
    first_y_m_ = map.first_y_m - radius_m_ - cell_m_;
    const auto cells = [&](int texels) {
      return static_cast<int>(std::ceil((texels * map.texel_m + 2.0 * radius_m_) / cell_m_)) + 3;
    };
    width_ = cells(map.width);
    const int height = cells(map.height);
    depth_.resize(static_cast<std::size_t>(width_) * height);
    ParallelFor(static_cast<std::size_t>(height), 0, [&](std::size_t row) {
      for (int column = 0; column < width_; ++column) {
        const Vec3 ground = rays.OnGround(first_x_m_ + column * cell_m_,
                                          first_y_m_ + static_cast<double>(row) * cell_m_);
        depth_[row * width_ + column] =
            static_cast<float>(field.DepthAlong(ground, rays.sun, seconds));
      }
    });
  }

  /// Bilinear. `in_disc`: place in the disc of the sun, as seen from the point.
  float At(double x_m, double y_m, Vec2 in_disc) const {
    const double x = (x_m + in_disc.x * radius_m_ - first_x_m_) / cell_m_;
    const double y = (y_m + in_disc.y * radius_m_ - first_y_m_) / cell_m_;
    const auto left = static_cast<std::size_t>(x), low = static_cast<std::size_t>(y);
    const auto u = static_cast<float>(x - static_cast<double>(left));
    const auto v = static_cast<float>(y - static_cast<double>(low));
    const float* at = &depth_[low * width_ + left];
    const float below = at[0] + u * (at[1] - at[0]);
    const float above = at[width_] + u * (at[width_ + 1] - at[width_]);
    return below + v * (above - below);
  }

 private:
  double radius_m_ = 0.0;  // The sun's disc at the layer's distance.
  double cell_m_ = 0.0, first_x_m_ = 0.0, first_y_m_ = 0.0;
  int width_ = 0;
  std::vector<float> depth_;
};

/// Places and counts the texels so that they cover the box.
void LayOut(const GroundBox& box, const AcrossRays& rays, CloudShadowMap* map) {
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point{(corner & 1) != 0 ? box.high_m.x : box.low_m.x,
                     (corner & 2) != 0 ? box.high_m.y : box.low_m.y,
                     (corner & 4) != 0 ? box.high_m.z : box.low_m.z};
    const double x = Dot(point, rays.x), y = Dot(point, rays.y);
    low = {std::min(low.x, x), std::min(low.y, y)};
    high = {std::max(high.x, x), std::max(high.y, y)};
  }
  const double longest = std::max(high.x - low.x, high.y - low.y);
  map->across_x = rays.x;
  map->across_y = rays.y;
  map->texel_m = std::max(kShadowTexel_m, longest / (kMaxShadowSide - 2));
  map->first_x_m = low.x;
  map->first_y_m = low.y;
  map->width = static_cast<int>(std::ceil((high.x - low.x) / map->texel_m)) + 1;
  map->height = static_cast<int>(std::ceil((high.y - low.y) / map->texel_m)) + 1;
}

}  // namespace

double CloudShadowMap::Mean() const {
  double sum = 0.0;
  for (const float value : share) sum += value;
  return share.empty() ? 1.0 : sum / static_cast<double>(share.size());
}

double CloudShadowMap::At(Vec3 point_m) const {
  if (share.empty()) return 1.0;
  return BilinearAt(share, width, height, (Dot(point_m, across_x) - first_x_m) / texel_m,
                    (Dot(point_m, across_y) - first_y_m) / texel_m);
}

CloudShadowMap MakeCloudShadowMap(const CloudFields& fields, const GroundBox& box,
                                  Direction<World> to_sun, double seconds) {
  CloudShadowMap map;
  if (to_sun.xyz.z <= 0.0 || fields.empty()) {
    map.across_x = {1.0, 0.0, 0.0};
    map.across_y = {0.0, 1.0, 0.0};
    map.texel_m = kShadowTexel_m;
    map.width = map.height = 1;
    map.share = {to_sun.xyz.z <= 0.0 ? 0.0F : 1.0F};
    return map;
  }
  const AcrossRays rays(to_sun);
  LayOut(box, rays, &map);
  std::vector<DepthGrid> grids;
  grids.reserve(fields.size());
  for (const auto& field : fields) grids.emplace_back(*field, rays, map, seconds);
  map.share.resize(static_cast<std::size_t>(map.width) * map.height);
  std::array<Vec2, kSunDiscRays> disc;
  for (int i = 0; i < kSunDiscRays; ++i) disc[static_cast<std::size_t>(i)] = InUnitDisc(i);
  ParallelFor(static_cast<std::size_t>(map.height), 0, [&](std::size_t row) {
    for (int column = 0; column < map.width; ++column) {
      const double x = map.first_x_m + column * map.texel_m;
      const double y = map.first_y_m + static_cast<double>(row) * map.texel_m;
      float sum = 0.0F;
      for (const Vec2 in_disc : disc) {
        float depth = 0.0F;
        for (const DepthGrid& grid : grids) depth += grid.At(x, y, in_disc);
        sum += std::exp(-depth);
      }
      map.share[row * map.width + column] = sum / kSunDiscRays;
    }
  });
  return map;
}

}  // namespace pleinair::clouds
