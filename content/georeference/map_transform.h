#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "content/georeference/local_frame.h"

namespace pleinair::content {

/// How heights of the content relate to the height of the place.
enum class HeightDatum {
  kShared,       ///< The CRS states none: both are taken to have the same reference.
  kTransformed,  ///< Both are transformed to heights above the ellipsoid.
};

/// What a transform assumes, for reports.
struct TransformFacts {
  std::string crs;        ///< Name and code of the content's CRS.
  std::string operation;  ///< PROJ's name of the operation to WGS 84.
  /// The operation's accuracy, as its authority states it, metres. 0: no change of datum.
  double accuracy_m = 0.0;
  bool datum_unknown = false;  ///< The datum is taken for WGS 84; errors reach hundreds of metres.
  std::vector<std::string> missing_grids;  ///< Not installed; a more accurate operation needs them.
  HeightDatum heights = HeightDatum::kShared;
  std::string vertical;  ///< The content's vertical reference; empty: not stated.
  /// The geoid's height above the ellipsoid at the place, metres. Set if the place's height above
  /// sea level was transformed.
  std::optional<double> undulation_m;
  std::string geoid;                ///< Its CRS, "EGM96 height".
  bool place_outside_area = false;  ///< The place lies outside the CRS's area of use.
  std::string area;                 ///< Its name; empty: not stated.
};

/// A point of the map, in the units of the CRS: x east, y north, z up, or longitude and latitude in
/// degrees. The axis order of the authority does not matter.
using MapPoint = Vec3;

/// Transforms coordinates of any CRS to east, north, up at a place. Each point passes the CRS's
/// exact formulae and LocalFrame; no step is linear or uses grid north. So meridian convergence,
/// scale of the projection and curvature of the Earth need no correction.
///
/// Heights. If the CRS states a vertical reference, content and place are transformed to heights
/// above the ellipsoid, by geoid grids where needed. Else both are taken to share one reference. A
/// geoid N metres above the ellipsoid then scales distances by 1 − N/R: 14 mm at 2 km for 45 m.
///
/// Not thread-safe: one thread at a time.
class MapTransform {
 public:
  /// `where` names the file in errors. Errors (input): the CRS is not known; the place is not on
  /// Earth. A grid for its heights is missing: the error names it and the remedy.
  static Result<MapTransform> Create(const std::string& crs, const Place& place,
                                     const std::string& where);
  ~MapTransform();
  MapTransform(MapTransform&&) noexcept;
  MapTransform& operator=(MapTransform&&) noexcept;

  /// Longitude, latitude and height of a point, the latter in the reference of facts(). Unset: a
  /// coordinate is not finite, or the CRS is not defined there.
  std::optional<GeodeticPoint> Geodetic(const MapPoint& point) const;
  /// As Geodetic(), in the tangent frame of the place.
  std::optional<Point<World>> EastNorthUp(const MapPoint& point) const;

  /// The point of the map at a geodetic place whose height has the reference of facts(). Unset: as
  /// of Geodetic().
  std::optional<MapPoint> OnMap(const GeodeticPoint& point) const;

  /// True if the point lies in the CRS's area of use, or if that is not stated.
  bool InArea(const GeodeticPoint& point) const;

  const TransformFacts& facts() const;
  const LocalFrame& frame() const;
  bool geographic() const;  ///< The CRS has longitudes and latitudes.

 private:
  struct Parts;
  explicit MapTransform(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace pleinair::content
