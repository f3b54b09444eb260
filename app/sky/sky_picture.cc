#include "app/sky/sky_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "base/parallel_for.h"
#include "sky/sun/solar_disc.h"
#include "sky/sun/sun_direction.h"

namespace pleinair::app {
namespace {

using std::numbers::pi;

int HeightOf(const SkyPictureOptions& options) {
  return options.projection == SkyProjection::kFisheye ? options.width_px : options.width_px / 2;
}

double FisheyeRadius(const SkyPictureOptions& options) { return 0.5 * options.width_px; }

void Put(LightImage* picture, int x, int y, LinearRgb color) {
  (*picture)(x, y, 0) = static_cast<float>(color.r);
  (*picture)(x, y, 1) = static_cast<float>(color.g);
  (*picture)(x, y, 2) = static_cast<float>(color.b);
}

/// Processes the rows in parallel.
void ForEachRow(int rows, const std::function<void(int)>& work) {
  ParallelFor(static_cast<std::size_t>(rows), 0,
              [&](std::size_t row) { work(static_cast<int>(row)); });
}

/// Solid angle of a square of `side_px` around a position.
double SolidAngle(const SkyPictureOptions& options, Vec2 place_px, double side_px) {
  if (options.projection == SkyProjection::kLatLong) {
    const double step = 2.0 * pi / options.width_px * side_px;
    return step * step * std::max(0.0, std::sin(place_px.y * 2.0 * pi / options.width_px));
  }
  // r = R z / 90°: dω = sin z dz dφ.
  const double per_px = 0.5 * pi / FisheyeRadius(options);
  const double r = Norm(place_px - Vec2{FisheyeRadius(options), FisheyeRadius(options)});
  const double z = r * per_px;
  return per_px * per_px * (z > 1e-9 ? std::sin(z) / z : 1.0) * side_px * side_px;
}

/// Adds the disc. Each pixel gets the mean over a fine grid of directions. A common factor then
/// makes the sum equal to the disc's light, whatever the grid missed.
void AddDisc(const sky::SkyModel& sky, const SkyPictureOptions& options, LightImage* picture) {
  constexpr int kGrid = 16;
  const LinearRgb light = sky.SunNormalIrradiance();
  if (Luminance(light) <= 0.0) return;
  // The sun's distance affects only its light here: the radius varies by 1.7 %.
  const double radius = sky::kSolarRadiusAt1Au;
  const Vec3 to_sun = sky.ToSun().xyz;
  const int height = HeightOf(options);
  // The sun's centre may be up to one radius below the horizon.
  const Vec3 seen = to_sun.z >= 0.0 ? to_sun : sky::LiftedToHorizon(to_sun);
  const Vec2 centre = PlaceInPicture(options, {seen});
  const double px_per_radian =
      options.width_px / (2.0 * pi) * (options.projection == SkyProjection::kFisheye ? 2.0 : 1.0);
  const double stretch = options.projection == SkyProjection::kLatLong
                             ? 1.0 / std::max(1e-3, std::hypot(to_sun.x, to_sun.y))
                             : 0.5 * pi;
  const int reach_y = static_cast<int>(std::ceil(1.6 * radius * px_per_radian)) + 1;
  const int reach_x =
      std::min(options.width_px / 2,
               static_cast<int>(std::ceil(1.6 * radius * px_per_radian * stretch)) + 1);
  struct Share {
    int x, y;
    double mean;
  };
  std::vector<Share> shares;
  double total = 0.0;
  const int cx = static_cast<int>(std::floor(centre.x)),
            cy = static_cast<int>(std::floor(centre.y));
  for (int y = std::max(0, cy - reach_y); y <= std::min(height - 1, cy + reach_y); ++y) {
    for (int dx = -reach_x; dx < reach_x + (2 * reach_x < options.width_px ? 1 : 0); ++dx) {
      int x = cx + dx;
      if (options.projection == SkyProjection::kLatLong) {
        x = (x % options.width_px + options.width_px) % options.width_px;
      }
      if (x < 0 || x >= options.width_px) continue;
      double mean = 0.0;
      for (int i = 0; i < kGrid * kGrid; ++i) {
        const int row = i / kGrid, column = i % kGrid;
        const Vec2 place{x + (column + 0.5) / kGrid, y + (row + 0.5) / kGrid};
        const auto direction = DirectionInPicture(options, place);
        if (!direction || direction->xyz.z < 0.0) continue;
        const double angle = sky::AngleBetween(direction->xyz, to_sun);
        mean += sky::LimbDarkening(angle, radius) / (kGrid * kGrid);
      }
      if (mean <= 0.0) continue;
      shares.push_back({x, y, mean});
      total += mean * SolidAngle(options, {x + 0.5, y + 0.5}, 1.0);
    }
  }
  if (total <= 0.0) {  // The pixels are so large that the grid missed the disc.
    const int x = std::clamp(cx, 0, options.width_px - 1), y = std::clamp(cy, 0, height - 1);
    shares.push_back({x, y, 1.0});
    total = SolidAngle(options, {x + 0.5, y + 0.5}, 1.0);
  }
  for (const Share& share : shares) {
    const LinearRgb disc = light * (share.mean / total);
    (*picture)(share.x, share.y, 0) += static_cast<float>(disc.r);
    (*picture)(share.x, share.y, 1) += static_cast<float>(disc.g);
    (*picture)(share.x, share.y, 2) += static_cast<float>(disc.b);
  }
}

}  // namespace

LinearRgb GroundRadiance(const sky::SkyModel& sky, double albedo) {
  const double sun_up = std::max(0.0, sky.ToSun().xyz.z);
  return (sky.SkyHorizontalIrradiance() + sky.SunNormalIrradiance() * sun_up) * (albedo / pi);
}

std::optional<Direction<World>> DirectionInPicture(const SkyPictureOptions& options,
                                                   Vec2 place_px) {
  if (options.projection == SkyProjection::kLatLong) {
    const double azimuth = FromDegrees(options.centre_azimuth_deg).value() +
                           2.0 * pi * (place_px.x / options.width_px - 0.5);
    const double zenith_angle = place_px.y * 2.0 * pi / options.width_px;
    const double horizontal = std::sin(zenith_angle);
    return Direction<World>{
        {horizontal * std::sin(azimuth), horizontal * std::cos(azimuth), std::cos(zenith_angle)}};
  }
  const double radius = FisheyeRadius(options);
  const Vec2 from_centre = place_px - Vec2{radius, radius};
  const double r = Norm(from_centre);
  if (r > radius) return std::nullopt;
  if (r == 0.0) return Direction<World>{{0.0, 0.0, 1.0}};
  const double zenith_angle = 0.5 * pi * r / radius;
  const double horizontal = std::sin(zenith_angle) / r;
  // East is left, north is up.
  return Direction<World>{
      {-horizontal * from_centre.x, -horizontal * from_centre.y, std::cos(zenith_angle)}};
}

Vec2 PlaceInPicture(const SkyPictureOptions& options, Direction<World> direction) {
  const Vec3 d = direction.xyz;
  const double horizontal = std::hypot(d.x, d.y);
  const double zenith_angle = std::atan2(horizontal, d.z);
  if (options.projection == SkyProjection::kLatLong) {
    const double turns =
        (std::atan2(d.x, d.y) - FromDegrees(options.centre_azimuth_deg).value()) / (2.0 * pi) + 0.5;
    return {(turns - std::floor(turns)) * options.width_px,
            zenith_angle * options.width_px / (2.0 * pi)};
  }
  const double radius = FisheyeRadius(options);
  if (horizontal == 0.0) return {radius, radius};
  const double r = radius * zenith_angle / (0.5 * pi);
  return {radius - r * d.x / horizontal, radius - r * d.y / horizontal};
}

LightImage DrawSky(const sky::SkyModel& sky, const SkyPictureOptions& options) {
  const int height = HeightOf(options);
  LightImage picture(options.width_px, height, 3);
  const LinearRgb ground = GroundRadiance(sky, options.ground_albedo);
  const double rim = FisheyeRadius(options);
  ForEachRow(height, [&](int y) {
    for (int x = 0; x < options.width_px; ++x) {
      Vec2 place{x + 0.5, y + 0.5};
      double covered = 1.0;
      if (options.projection == SkyProjection::kFisheye) {
        const Vec2 from_centre = place - Vec2{rim, rim};
        const double r = Norm(from_centre);
        covered = std::clamp(rim - r + 0.5, 0.0, 1.0);  // Share of the pixel within the circle.
        if (covered == 0.0) continue;
        constexpr double kInside = 1.0 - 1e-9;
        if (r > rim * kInside) place = Vec2{rim, rim} + from_centre * (rim * kInside / r);
      }
      const Direction<World> direction = DirectionInPicture(options, place).value();
      Put(&picture, x, y, (direction.xyz.z >= 0.0 ? sky.SkyRadiance(direction) : ground) * covered);
    }
  });
  if (options.disc) AddDisc(sky, options, &picture);
  return picture;
}

}  // namespace pleinair::app
