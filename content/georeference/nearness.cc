#include "content/georeference/nearness.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace pleinair::content {
namespace {

/// A way in which coordinates are often mistaken, and what to do about it.
struct Mistake {
  MapPoint (*corrected)(const MapPoint&);
  const char* geographic;
  const char* projected;
};

constexpr std::array<Mistake, 3> kMistakes = {{
    {[](const MapPoint& p) {
       return MapPoint{p.y, p.x, p.z};
     },
     "latitude and longitude are swapped: write longitude first",
     "easting and northing are swapped: write easting first"},
    // Grids with axes to the south and west (Krovak) have positive numbers on paper.
    {[](const MapPoint& p) {
       return MapPoint{-p.x, -p.y, p.z};
     },
     "both signs are wrong: east and north are positive",
     "both signs are wrong: this system has negative coordinates here"},
    {[](const MapPoint& p) {
       return MapPoint{-p.y, -p.x, p.z};
     },
     "latitude and longitude are swapped and have wrong signs",
     "the coordinates are swapped and have wrong signs: write minus the second, then minus the "
     "first"},
}};

struct Nearest {
  GeodesicWay way;
  bool found = false;
};

Nearest NearestOf(const MapTransform& transform, std::span<const MapPoint> points, double radius_m,
                  MapPoint (*corrected)(const MapPoint&)) {
  Nearest nearest;
  for (const MapPoint& point : points) {
    const auto geodetic = transform.Geodetic(corrected ? corrected(point) : point);
    if (!geodetic) continue;
    const GeodesicWay way = ShortestWay(transform.frame().origin(), *geodetic);
    if (!nearest.found || way.distance_m < nearest.way.distance_m) nearest = {way, true};
    if (nearest.way.distance_m <= radius_m) break;
  }
  return nearest;
}

}  // namespace

std::string CompassPoint(double azimuth_deg) {
  constexpr std::array<const char*, 8> kPoints = {"north", "north-east", "east", "south-east",
                                                  "south", "south-west", "west", "north-west"};
  const long eighth = std::lround(azimuth_deg / 45.0) % 8;
  return kPoints[static_cast<std::size_t>(eighth < 0 ? eighth + 8 : eighth)];
}

std::string DescribeWay(const GeodesicWay& way) {
  const bool metres = way.distance_m < 1000.0;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), metres ? "%.1f m" : "%.1f km",
                metres ? way.distance_m : way.distance_m * 1e-3);
  std::array<char, 32> degrees{};
  std::snprintf(degrees.data(), degrees.size(), " (%.0f degrees)", way.azimuth_deg);
  return std::string(text.data()) + " " + CompassPoint(way.azimuth_deg) + degrees.data();
}

Result<void> CheckNear(const MapTransform& transform, std::span<const MapPoint> points,
                       double radius_m, const std::string& where) {
  const Nearest nearest = NearestOf(transform, points, radius_m, nullptr);
  if (nearest.found && nearest.way.distance_m <= radius_m) return {};
  std::array<char, 32> radius{};
  std::snprintf(radius.data(), radius.size(), "%.0f m", radius_m);
  const std::string what =
      nearest.found ? "all of it is farther than " + std::string(radius.data()) +
                          " from the marker; the nearest point is " + DescribeWay(nearest.way)
                    : "no point has a position in " + transform.facts().crs;
  for (const Mistake& mistake : kMistakes) {
    const Nearest other = NearestOf(transform, points, radius_m, mistake.corrected);
    if (other.found && other.way.distance_m <= radius_m) {
      return InputError(where, what,
                        transform.geographic() ? mistake.geographic : mistake.projected);
    }
  }
  return InputError(where, what,
                    "check the place and the coordinate reference system (" +
                        transform.facts().crs + "), or enlarge the radius");
}

}  // namespace pleinair::content
