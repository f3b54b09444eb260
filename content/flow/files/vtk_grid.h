#pragma once

// Internal: what VTK's XML and legacy files of structured grids have in common.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/vector.h"

namespace pleinair::content {

/// Values of a point or a cell each.
struct VtkArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
  bool is_double = true;  ///< False: the file has single precision.
};

/// The arrays of points, or of cells.
struct VtkArrays {
  std::vector<VtkArray> arrays;
  std::string active_vectors;  ///< Empty: none.
};

/// A structured grid with its arrays. Points run fastest along x.
struct VtkGrid {
  std::array<int, 3> counts{1, 1, 1};
  Vec3 origin, spacing{1.0, 1.0, 1.0};             ///< Image data.
  std::array<std::vector<double>, 3> coordinates;  ///< Rectilinear; else empty.
  std::vector<Vec3> points;                        ///< Structured; else empty.
  VtkArrays point_data, cell_data;

  std::size_t PointCount() const;
  std::size_t CellCount() const;
};

/// Parses .vti, .vtr and .vts: ASCII, base64 or appended arrays, plain or compressed by zlib, of
/// one piece. Errors (input): damage; other kinds of data; more than kMaxFieldNodes.
Result<VtkGrid> ParseVtkXml(std::string_view bytes, const std::string& where);

/// Parses legacy files, ASCII or binary, of STRUCTURED_POINTS, RECTILINEAR_GRID and
/// STRUCTURED_GRID. Errors as ParseVtkXml().
Result<VtkGrid> ParseVtkLegacy(std::string_view bytes, const std::string& where);

/// Sets the counts. Error (input): none, or more than kMaxFieldNodes points.
Result<void> SetCounts(const std::array<long long, 3>& counts, const std::string& where,
                       VtkGrid* grid);

constexpr const char* kVtkRemedy =
    "export it again; unstructured data: resample it to image data, for example with ParaView's "
    "filter Resample To Image";

}  // namespace pleinair::content
