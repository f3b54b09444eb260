#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "content/georeference/local_frame.h"
#include "content/georeference/map_transform.h"

namespace pleinair::content {

/// How heights of a terrain meet that of the marker.
enum class TerrainHeight {
  kMarker,  ///< The surface is shifted so that it passes through the marker's origin.
  kDatum,   ///< No shift: heights have the reference of the place, or are transformed to it.
};

struct TerrainOptions {
  int band = 1;
  std::string crs = {};       ///< In place of the file's; empty: that of the file.
  double max_error_m = 0.05;  ///< The triangulation's, vertical.
  double radius_m = 500.0;    ///< Cells farther from the marker are left out.
  TerrainHeight height = TerrainHeight::kMarker;
  double raised_by_m = 0.0;  ///< Added to all heights.
};

/// The surface of an elevation raster around the marker, as triangles. They lie in the tangent
/// frame of the place: east, north, up from the marker's origin, metres. Seen from above, corners
/// are counter-clockwise. Cells without data, and their borders, carry no triangles.
struct ElevationMesh {
  std::vector<Point<World>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  double shift_m = 0.0;            ///< Added to the raster's heights.
  double remaining_error_m = 0.0;  ///< Bound on the error of the triangulation; see RightTriangles.
  double cell_m = 0.0;             ///< Largest distance between neighbouring cells at the marker.
  std::size_t cells = 0;           ///< The raster's, with data, within the radius.
  TransformFacts facts;
  std::string crs_name;
};

/// Triangulates a raster (RasterFile). The truth is bilinear between the centres of cells, in the
/// tangent frame: the curvature of the Earth counts. Positions pass MapTransform every 64 m and are
/// interpolated between, within 0.2 mm. Errors (input): those of RasterFile
/// and of MapTransform; no CRS; nothing within the radius; more than kMaxVertices. With
/// TerrainHeight::kMarker also: no data at the marker.
Result<ElevationMesh> TriangulateRaster(const std::filesystem::path& file, const Place& place,
                                        const TerrainOptions& options);

}  // namespace pleinair::content
