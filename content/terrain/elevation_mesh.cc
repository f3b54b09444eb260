#include "content/terrain/elevation_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "base/image.h"
#include "base/parallel_for.h"
#include "base/vector.h"
#include "content/georeference/nearness.h"
#include "content/georeference/raster.h"
#include "content/georeference/vector_layer.h"
#include "content/terrain/right_triangles.h"

namespace pleinair::content {
namespace {

constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
constexpr double kFar_m = 1000.0;  // Height of the second point that gives the direction upwards.

/// A cell of a raster with the change of its place, metres east and north, to the next ones.
struct CellAtMarker {
  double x = 0.0, y = 0.0;
  Vec2 column_m, row_m;

  double Area_m2() const { return column_m.x * row_m.y - column_m.y * row_m.x; }
};

/// The cell in whose place the marker is, also beside the raster. Unset: none is found.
std::optional<CellAtMarker> FindMarker(const RasterFile& raster, const MapTransform& transform) {
  CellAtMarker cell{0.5 * raster.width(), 0.5 * raster.height(), {}, {}};
  constexpr int kMostSteps = 50;
  for (int step = 0; step < kMostSteps; ++step) {
    const auto here = transform.EastNorthUp(raster.CentreOf(cell.x, cell.y));
    const auto column = transform.EastNorthUp(raster.CentreOf(cell.x + 1.0, cell.y));
    const auto row = transform.EastNorthUp(raster.CentreOf(cell.x, cell.y + 1.0));
    if (!here || !column || !row) return std::nullopt;
    cell.column_m = {column->xyz.x - here->xyz.x, column->xyz.y - here->xyz.y};
    cell.row_m = {row->xyz.x - here->xyz.x, row->xyz.y - here->xyz.y};
    const double area_m2 = cell.Area_m2();
    if (area_m2 == 0.0) return std::nullopt;
    const double dx = (-here->xyz.x * cell.row_m.y + here->xyz.y * cell.row_m.x) / area_m2;
    const double dy = (here->xyz.x * cell.column_m.y - here->xyz.y * cell.column_m.x) / area_m2;
    if (!std::isfinite(dx + dy)) return std::nullopt;
    cell.x += dx;
    cell.y += dy;
    if (std::hypot(dx, dy) < 1e-6) return cell;
  }
  return std::nullopt;
}

/// The cells within a radius; empty where the raster has none.
RasterWindow WindowAround(const CellAtMarker& cell, double radius_m, const RasterFile& raster) {
  const double area_m2 = std::fabs(cell.Area_m2());
  const auto span = [&](double at, double across_m, int count) {
    // A band of the radius's width across the other direction, two cells wider.
    const double half = radius_m * across_m / area_m2 + 2.0;
    const double first = std::clamp(std::floor(at - half), 0.0, 1.0 * count);
    const double last = std::clamp(std::ceil(at + half) + 1.0, 0.0, 1.0 * count);
    return std::pair{static_cast<int>(first), static_cast<int>(last - first)};
  };
  const auto [x, width] = span(cell.x, Norm(cell.row_m), raster.width());
  const auto [y, height] = span(cell.y, Norm(cell.column_m), raster.height());
  return {x, y, width, height};
}

/// Places of the cells of a window: of height 0, and their change by a metre of height. They pass
/// the transform every 64 m and are interpolated between, where the Earth curves by 0.1 mm.
class CellPlaces {
 public:
  struct Ray {
    Vec3 foot_m, up;
  };

  CellPlaces(const RasterFile& raster, const MapTransform& transform, const RasterWindow& window,
             double cell_m)
      : step_(static_cast<int>(std::clamp(kStep_m / cell_m, 1.0, kMaxStep))),
        columns_((window.width - 1) / step_ + 2),
        rows_((window.height - 1) / step_ + 2) {
    rays_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        MapPoint at = raster.CentreOf(window.x + column * step_, window.y + row * step_);
        const auto foot = transform.EastNorthUp(at);
        at.z = kFar_m;
        const auto high = transform.EastNorthUp(at);
        constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
        const Vec3 nowhere{kNowhere, kNowhere, kNowhere};
        rays_.push_back(foot && high ? Ray{foot->xyz, (high->xyz - foot->xyz) * (1.0 / kFar_m)}
                                     : Ray{nowhere, nowhere});
      }
    }
  }

  Ray At(int x, int y) const {
    const int column = x / step_, row = y / step_;
    const double u = 1.0 * (x - column * step_) / step_, v = 1.0 * (y - row * step_) / step_;
    const auto mean = [&](Vec3 Ray::*part) {
      return (RayAt(column, row).*part * (1.0 - u) + RayAt(column + 1, row).*part * u) * (1.0 - v) +
             (RayAt(column, row + 1).*part * (1.0 - u) + RayAt(column + 1, row + 1).*part * u) * v;
    };
    return {mean(&Ray::foot_m), mean(&Ray::up)};
  }

 private:
  static constexpr double kStep_m = 64.0;
  static constexpr double kMaxStep = 32.0;  // Cells.
  const Ray& RayAt(int column, int row) const {
    return rays_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)];
  }

  int step_;  // Cells.
  int columns_, rows_;
  std::vector<Ray> rays_;
};

/// Turns heights into metres above the tangent plane. Cells beyond the radius get no data. Returns
/// the number of those that have.
std::size_t RaiseCells(const CellPlaces& places, double radius_m, Image<float>* heights) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(heights->height()));
  ParallelForBlocks(counts.size(), 32, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < heights->width(); ++x) {
        float& height = (*heights)(x, y);
        if (std::isnan(height)) continue;
        const CellPlaces::Ray ray = places.At(x, y);
        const Vec3 at = ray.foot_m + ray.up * static_cast<double>(height);
        height = std::hypot(at.x, at.y) <= radius_m ? static_cast<float>(at.z) : kNoData;
        if (!std::isnan(height)) ++counts[row];
      }
    }
  });
  std::size_t sum = 0;
  for (const std::size_t count : counts) sum += count;
  return sum;
}

/// Bilinear between the centres of cells; not a number where one of them has no data.
float HeightBetween(const Image<float>& up_m, double x, double y) {
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  if (column < 0 || row < 0 || column + 1 >= up_m.width() || row + 1 >= up_m.height()) {
    return kNoData;
  }
  const auto u = static_cast<float>(x - column), v = static_cast<float>(y - row);
  return (up_m(column, row) * (1 - u) + up_m(column + 1, row) * u) * (1 - v) +
         (up_m(column, row + 1) * (1 - u) + up_m(column + 1, row + 1) * u) * v;
}

/// The error of a raster that is not near: CheckNear() of points along its borders.
Result<void> NothingNear(const RasterFile& raster, const MapTransform& transform, double radius_m,
                         const std::string& where) {
  constexpr int kPoints = 32;
  std::vector<MapPoint> border;
  border.reserve(4 * kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double x = (raster.width() - 1.0) * i / (kPoints - 1);
    const double y = (raster.height() - 1.0) * i / (kPoints - 1);
    border.push_back(raster.CentreOf(x, 0.0));
    border.push_back(raster.CentreOf(x, raster.height() - 1.0));
    border.push_back(raster.CentreOf(0.0, y));
    border.push_back(raster.CentreOf(raster.width() - 1.0, y));
  }
  PLEINAIR_RETURN_IF_ERROR(CheckNear(transform, border, radius_m, where));
  return InputError(where, "has no data within the radius of the marker",
                    "choose a larger radius, or a raster that covers the place");
}

/// Adds the triangles of the heights to a mesh. Returns whether it has at most kMaxVertices.
bool AddTriangles(const Image<float>& up_m, const CellPlaces& places, bool is_mirrored,
                  double max_error_m, ElevationMesh* mesh) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  Image<std::uint32_t> numbers(up_m.width(), up_m.height());
  std::fill_n(numbers.data(), numbers.size(), kNone);
  const auto number_of = [&](const GridCorner& corner) {
    std::uint32_t& number = numbers(corner.x, corner.y);
    if (number == kNone) {
      number = static_cast<std::uint32_t>(mesh->vertices.size());
      const CellPlaces::Ray ray = places.At(corner.x, corner.y);
      const double height_m = (up_m(corner.x, corner.y) - ray.foot_m.z) / ray.up.z;
      Vec3 at = ray.foot_m + ray.up * height_m;
      at.z += mesh->shift_m;
      mesh->vertices.push_back({at});
    }
    return number;
  };
  const RightTriangles network(up_m);
  mesh->remaining_error_m =
      network.Emit(static_cast<float>(max_error_m), [&](const GridTriangle& triangle) {
        if (mesh->vertices.size() > kMaxVertices) return;
        std::array<std::uint32_t, 3> corners{number_of(triangle[0]), number_of(triangle[1]),
                                             number_of(triangle[2])};
        if (is_mirrored) std::swap(corners[1], corners[2]);
        mesh->triangles.push_back(corners);
      });
  return mesh->vertices.size() <= kMaxVertices;
}

}  // namespace

Result<ElevationMesh> TriangulateRaster(const std::filesystem::path& file, const Place& place,
                                        const TerrainOptions& options) {
  const std::string where = file.string();
  PLEINAIR_ASSIGN_OR_RETURN(const RasterFile raster, RasterFile::Open(file, options.band));
  const std::string& crs = options.crs.empty() ? raster.crs() : options.crs;
  if (crs.empty()) {
    return InputError(where, "states no coordinate reference system",
                      "give it with crs, for example EPSG:32633");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const MapTransform transform,
                            MapTransform::Create(crs, place, options.crs.empty() ? where : "crs"));
  const std::optional<CellAtMarker> marker = FindMarker(raster, transform);
  RasterWindow window;
  if (marker) window = WindowAround(*marker, options.radius_m, raster);
  if (window.width < 2 || window.height < 2) {
    PLEINAIR_RETURN_IF_ERROR(NothingNear(raster, transform, options.radius_m, where));
  }
  PLEINAIR_ASSIGN_OR_RETURN(Image<float> up_m, raster.Read(window));
  const double cell_m = std::max(Norm(marker->column_m), Norm(marker->row_m));
  const CellPlaces places(raster, transform, window, cell_m);
  ElevationMesh mesh;
  mesh.facts = transform.facts();
  mesh.crs_name = options.crs.empty() ? raster.crs_name() : options.crs;
  mesh.cell_m = cell_m;
  mesh.cells = RaiseCells(places, options.radius_m, &up_m);
  if (mesh.cells == 0) {
    PLEINAIR_RETURN_IF_ERROR(NothingNear(raster, transform, options.radius_m, where));
  }
  mesh.shift_m = options.raised_by_m;
  if (options.height == TerrainHeight::kMarker) {
    const float at_marker_m = HeightBetween(up_m, marker->x - window.x, marker->y - window.y);
    if (std::isnan(at_marker_m)) {
      return InputError(where, "has no data at the marker, whose height it should have there",
                        "give height = \"datum\" or a number of metres, or a raster that covers "
                        "the marker");
    }
    mesh.shift_m -= static_cast<double>(at_marker_m);
  }
  if (!AddTriangles(up_m, places, marker->Area_m2() < 0.0, options.max_error_m, &mesh)) {
    return InputError(where, "needs more than 20 million vertices within this error",
                      "allow a larger error, or choose a smaller radius");
  }
  return mesh;
}

}  // namespace pleinair::content
