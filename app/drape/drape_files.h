#pragma once

#include <filesystem>
#include <string>

#include "app/drape/draped_map.h"
#include "base/error.h"
#include "base/vector.h"
#include "content/georeference/local_frame.h"

namespace pleinair::app {

/// Where and how draped lines are written.
struct DrapeOutput {
  std::filesystem::path file;  ///< The ending chooses the kind.
  Mat3 marker_from_world;      ///< The heading of the marker.
  content::Place place;        ///< The origin of the marker.
  std::string crs;             ///< Of a GeoPackage; empty: WGS 84.
};

/// Checks the ending, and that `crs` belongs to a GeoPackage. Errors (input).
Result<void> CheckDrapeOutput(const DrapeOutput& output);

/// Writes lines as CSV (a row for each vertex), GeoJSON, GeoPackage, OBJ or glTF binary.
/// docs/guide/draping.md describes them. Errors: those of writing, and of WriteGeoPackage().
Result<void> WriteDrape(const DrapedMaps& maps, const DrapeOutput& output);

/// The glTF binary of WriteDrape(): lines and points in marker coordinates below a node that turns
/// them, so that y is up as glTF has it.
std::string DrapeGlb(const DrapedMaps& maps, const Mat3& marker_from_world);

}  // namespace pleinair::app
