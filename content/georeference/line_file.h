#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "content/georeference/map_transform.h"

namespace pleinair::content {

/// A line to be written; a point if it has one vertex.
struct WrittenLine {
  std::uint32_t feature = 0;
  std::size_t part = 0;  ///< Of the feature, from 0 on.
  std::vector<GeodeticPoint> points;
};

/// Writes lines with heights as the layer "drape" of a GeoPackage, with the fields `feature` and
/// `part`. The file is replaced when it is complete. `transform`: to the CRS `crs` of the file,
/// text as MapTransform::Create() takes it. Errors: a point without a place in the CRS (input), a
/// file that cannot be written.
Result<void> WriteGeoPackage(const std::filesystem::path& file, const std::string& crs,
                             const MapTransform& transform, std::span<const WrittenLine> lines);

}  // namespace pleinair::content
