#include "content/flow/files/field_chart.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/units.h"

namespace pleinair::content {
namespace {

// WGS 84.
constexpr double kSemiMajor_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kMinCosine = 1e-3;  // At the poles, east has no direction.

/// Metres per degree of longitude and latitude.
Vec2 MetresPerDegree(double latitude_deg) {
  const double latitude = latitude_deg * kRadiansPerDegree;
  const double sine = std::sin(latitude);
  const double w2 = 1.0 - kEccentricity2 * sine * sine;
  const double normal_m = kSemiMajor_m / std::sqrt(w2);
  const double meridian_m = normal_m * (1.0 - kEccentricity2) / w2;
  return {kRadiansPerDegree * normal_m * std::max(kMinCosine, std::cos(latitude)),
          kRadiansPerDegree * meridian_m};
}

/// The transform that PROJ chooses for a point of a map.
Result<MapTransform> TransformNear(const std::string& crs, const Vec3& point,
                                   const std::string& where) {
  Place place{0.0, 0.0, 0.0, HeightReference::kEllipsoid};
  PLEINAIR_ASSIGN_OR_RETURN(MapTransform anywhere, MapTransform::Create(crs, place, where));
  const auto geodetic = anywhere.Geodetic({point.x, point.y, 0.0});
  if (!geodetic) return anywhere;
  place.latitude_deg = geodetic->latitude_deg;
  place.longitude_deg = std::remainder(geodetic->longitude_deg, 360.0);
  return MapTransform::Create(crs, place, where);
}

}  // namespace

FieldChart FieldChart::Projected(std::string crs) {
  FieldChart chart;
  chart.kind_ = ChartKind::kProjected;
  chart.crs_ = std::move(crs);
  return chart;
}

FieldChart FieldChart::Geographic(double middle_longitude_deg, double middle_latitude_deg) {
  FieldChart chart;
  chart.kind_ = ChartKind::kGeographic;
  chart.crs_ = "EPSG:4326";
  chart.middle_ = {middle_longitude_deg, middle_latitude_deg, 0.0};
  const Vec2 scale = MetresPerDegree(middle_latitude_deg);
  chart.x_per_deg_ = scale.x;
  chart.y_per_deg_ = scale.y;
  return chart;
}

double FieldChart::LongitudeFromMiddle(double longitude_deg) const {
  const double off = longitude_deg - middle_.longitude_deg;
  return off - 360.0 * std::floor((off + 180.0) / 360.0);
}

Vec3 FieldChart::FromFile(const Vec3& point) const {
  if (kind_ != ChartKind::kGeographic) return point;
  return {LongitudeFromMiddle(point.x) * x_per_deg_, (point.y - middle_.latitude_deg) * y_per_deg_,
          point.z};
}

Vec3 FieldChart::ToFile(const Vec3& point) const {
  if (kind_ != ChartKind::kGeographic) return point;
  return {middle_.longitude_deg + point.x / x_per_deg_, middle_.latitude_deg + point.y / y_per_deg_,
          point.z};
}

Vec3 FieldChart::StretchAt(double latitude_deg) const {
  if (kind_ != ChartKind::kGeographic) return {1.0, 1.0, 1.0};
  const Vec2 scale = MetresPerDegree(latitude_deg);
  return {x_per_deg_ / scale.x, y_per_deg_ / scale.y, 1.0};
}

Vec3 FieldChart::Stretch(const Vec3& point) const {
  return StretchAt(middle_.latitude_deg + point.y / y_per_deg_);
}

Result<OutputFrame> OutputFrame::OfFile(const FieldChart& chart, const Vec3& middle,
                                        double half_width_deg, const std::string& where) {
  OutputFrame frame(chart);
  if (chart.kind() == ChartKind::kOwn) return frame;
  frame.in_tangent_plane_ =
      chart.kind() == ChartKind::kGeographic && half_width_deg <= kMaxTangent_deg;
  PLEINAIR_ASSIGN_OR_RETURN(frame.transform_,
                            TransformNear(chart.crs(), chart.ToFile(middle), where));
  frame.facts_ = frame.transform_->facts();
  return frame;
}

Result<OutputFrame> OutputFrame::OfMarker(const FieldChart& chart, const std::string& crs,
                                          const Place& place, const Mat3& marker_from_world,
                                          bool has_heights, const std::string& where) {
  OutputFrame frame(chart);
  if (crs == "marker") return frame;
  const std::string& used = crs.empty() ? chart.crs() : crs;
  if (used.empty()) {
    return InputError(where, "states no coordinate reference system",
                      "give --crs, for example EPSG:32633, or --crs marker for metres of the "
                      "marker's frame");
  }
  PLEINAIR_ASSIGN_OR_RETURN(frame.transform_, MapTransform::Create(used, place, where));
  frame.facts_ = frame.transform_->facts();
  frame.in_marker_ = true;
  frame.marker_from_world_ = marker_from_world;
  if (!has_heights) frame.height_m_ = frame.transform_->frame().origin().height_m;
  return frame;
}

Vec3 OutputFrame::WithHeight(const Vec3& file_point) const {
  return {file_point.x, file_point.y, height_m_.value_or(file_point.z)};
}

std::optional<Vec3> OutputFrame::FromField(const Vec3& point) const {
  const Vec3 in_file = WithHeight(chart_.ToFile(point));
  if (in_marker_) {
    const auto enu = transform_->EastNorthUp(in_file);
    if (!enu) return std::nullopt;
    return marker_from_world_ * enu->xyz;
  }
  if (!in_tangent_plane_) return point;
  const auto enu = transform_->EastNorthUp({in_file.x, in_file.y, 0.0});
  if (!enu) return std::nullopt;
  return Vec3{enu->xyz.x, enu->xyz.y, point.z};
}

std::optional<GeodeticPoint> OutputFrame::Geodetic(const Vec3& point) const {
  if (chart_.kind() == ChartKind::kGeographic && !in_marker_) {
    const Vec3 in_file = chart_.ToFile(point);
    return GeodeticPoint{std::remainder(in_file.x, 360.0), in_file.y, in_file.z};
  }
  if (!transform_) return std::nullopt;
  return transform_->Geodetic(WithHeight(chart_.ToFile(point)));
}

Result<GridConvergence> GridConvergence::Create(const std::string& crs, const Vec2& low,
                                                const Vec2& high, const std::string& where) {
  const Vec2 middle = (low + high) * 0.5;
  PLEINAIR_ASSIGN_OR_RETURN(const MapTransform transform,
                            TransformNear(crs, {middle.x, middle.y, 0.0}, where));
  GridConvergence convergence;
  convergence.low_ = low;
  convergence.size_ = {std::max(high.x - low.x, 1e-9), std::max(high.y - low.y, 1e-9)};
  const double step_m = 1.0;  // Along grid north: the meridian's curvature is of no account.
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const Vec3 at{low.x + convergence.size_.x * column / (kSide - 1.0),
                    low.y + convergence.size_.y * row / (kSide - 1.0), 0.0};
      const auto south = transform.Geodetic({at.x, at.y - 0.5 * step_m, 0.0});
      const auto north = transform.Geodetic({at.x, at.y + 0.5 * step_m, 0.0});
      if (!south || !north) {
        return InputError(where,
                          "its grid extends beyond where " + transform.facts().crs + " is defined",
                          "check the coordinate reference system, or cut out a part");
      }
      const Vec2 scale = MetresPerDegree(0.5 * (south->latitude_deg + north->latitude_deg));
      const double east =
          std::remainder(north->longitude_deg - south->longitude_deg, 360.0) * scale.x;
      convergence.angle_rad_.push_back(
          -std::atan2(east, (north->latitude_deg - south->latitude_deg) * scale.y));
    }
  }
  return convergence;
}

Vec2 GridConvergence::Turned(const Vec2& at, const Vec2& east_north) const {
  const double x = std::clamp((at.x - low_.x) / size_.x, 0.0, 1.0) * (kSide - 1);
  const double y = std::clamp((at.y - low_.y) / size_.y, 0.0, 1.0) * (kSide - 1);
  const int column = std::min(static_cast<int>(x), kSide - 2);
  const int row = std::min(static_cast<int>(y), kSide - 2);
  const double u = x - column, v = y - row;
  const auto angle = [&](int c, int r) {
    return angle_rad_[static_cast<std::size_t>(r * kSide + c)];
  };
  const double turn = (angle(column, row) * (1 - u) + angle(column + 1, row) * u) * (1 - v) +
                      (angle(column, row + 1) * (1 - u) + angle(column + 1, row + 1) * u) * v;
  // True north lies `turn` clockwise from grid north.
  const double c = std::cos(turn), s = std::sin(turn);
  return {east_north.x * c + east_north.y * s, -east_north.x * s + east_north.y * c};
}

}  // namespace pleinair::content
