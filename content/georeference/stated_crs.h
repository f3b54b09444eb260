#pragma once

// Internal: the CRS that a file states, as GDAL reads it.

#include <ogr_srs_api.h>

#include <string>

namespace pleinair::content {

/// The coordinate reference system that a file states.
struct StatedCrs {
  std::string text;  ///< For MapTransform::Create(), a code or WKT; empty: none is stated.
  std::string name;
  bool has_code = false;  ///< `text` is a code, such as "EPSG:32633".

  /// "WGS 84 / UTM zone 33N (EPSG:32633)".
  std::string ForPeople() const { return has_code ? name + " (" + text + ")" : name; }
};

/// `srs`: null if the file states none.
StatedCrs ReadStatedCrs(OGRSpatialReferenceH srs);

}  // namespace pleinair::content
