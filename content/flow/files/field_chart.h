#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "content/georeference/local_frame.h"
#include "content/georeference/map_transform.h"

namespace pleinair::content {

/// What the coordinates of a file are.
enum class ChartKind {
  kOwn,         ///< Metres of the file's own axes.
  kProjected,   ///< Metres of a map projection.
  kGeographic,  ///< Longitudes and latitudes.
};

/// The coordinates of a field and those of its file. Fields have metres. Those of a geographic file
/// are x = (λ − λ₀) ν₀ cos φ₀ and y = (φ − φ₀) M₀, with the radii of curvature at the middle of the
/// domain; the velocities of the nodes are scaled alike. So paths are exact on the ellipsoid, and
/// metres of the field are true metres in the middle alone (Stretch()).
class FieldChart {
 public:
  FieldChart() = default;
  static FieldChart Own() { return {}; }
  static FieldChart Projected(std::string crs);
  static FieldChart Geographic(double middle_longitude_deg, double middle_latitude_deg);

  ChartKind kind() const { return kind_; }
  const std::string& crs() const { return crs_; }  ///< Empty: not stated.
  const GeodeticPoint& middle() const { return middle_; }

  /// The place of a point of the file: x and y, or longitude and latitude in degrees.
  Vec3 FromFile(const Vec3& point) const;
  Vec3 ToFile(const Vec3& point) const;
  /// Longitudes by the shortest way from the middle, −180…180 around it.
  double LongitudeFromMiddle(double longitude_deg) const;

  /// Field metres per true metre, by axis.
  Vec3 Stretch(const Vec3& point) const;
  Vec3 StretchAt(double latitude_deg) const;

 private:
  ChartKind kind_ = ChartKind::kOwn;
  std::string crs_;
  GeodeticPoint middle_;
  double x_per_deg_ = 1.0, y_per_deg_ = 1.0;  // Metres.
};

/// From a field to the coordinates of the output.
class OutputFrame {
 public:
  /// Those of the file; of geographic files metres east and north of the middle, in its tangent
  /// plane. Where the domain is wider than kMaxTangent_deg to a side, the metres of the field.
  /// `middle`: of the field.
  static Result<OutputFrame> OfFile(const FieldChart& chart, const Vec3& middle,
                                    double half_width_deg, const std::string& where);
  /// Marker coordinates. `crs`: in place of the file's; "marker": the file's own metres are those
  /// of the marker. Heights of 2D fields are the marker's. Errors (input): no CRS; those of
  /// MapTransform.
  static Result<OutputFrame> OfMarker(const FieldChart& chart, const std::string& crs,
                                      const Place& place, const Mat3& marker_from_world,
                                      bool has_heights, const std::string& where);

  /// Unset: the map projection is not defined there.
  std::optional<Vec3> FromField(const Vec3& point) const;
  /// Longitude, latitude and height; unset: the file has no place on Earth.
  std::optional<GeodeticPoint> Geodetic(const Vec3& point) const;
  const std::optional<TransformFacts>& facts() const { return facts_; }

  static constexpr double kMaxTangent_deg = 30.0;

 private:
  explicit OutputFrame(FieldChart chart) : chart_(std::move(chart)) {}
  Vec3 WithHeight(const Vec3& file_point) const;

  FieldChart chart_;
  std::optional<MapTransform> transform_;
  std::optional<TransformFacts> facts_;
  bool in_marker_ = false, in_tangent_plane_ = false;
  Mat3 marker_from_world_;
  std::optional<double> height_m_;  // Of 2D fields.
};

/// Grid north against true north at points of a projected map: the direction of true east and true
/// north along the grid's axes, from a lattice over a box.
class GridConvergence {
 public:
  /// Errors (input): those of MapTransform; the projection is not defined in the box.
  static Result<GridConvergence> Create(const std::string& crs, const Vec2& low, const Vec2& high,
                                        const std::string& where);

  /// Components along the grid's axes of a velocity to the east and north.
  Vec2 Turned(const Vec2& at, const Vec2& east_north) const;

 private:
  static constexpr int kSide = 33;
  Vec2 low_, size_;
  std::vector<double> angle_rad_;  // Of true north, clockwise from grid north.
};

}  // namespace pleinair::content
