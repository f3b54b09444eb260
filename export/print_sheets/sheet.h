#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::exports {

// What is printed on one page, in millimetres from the page's top-left corner, x right, y down. All
// of it is black on white; renderers (pdf.h, svg.h, sheet_raster.h) draw it true to scale.

struct PageSize {
  double width_mm = 210.0;
  double height_mm = 297.0;
  bool operator==(const PageSize&) const = default;
};

/// "A4" (also A0…A5, letter), upright; "A4-landscape"; or "WIDTHxHEIGHT" in mm, 30 to 5000 a side.
/// Errors (input): anything else.
Result<PageSize> ParsePageSize(const std::string& text);

/// "A4-landscape", or "300x400" for a size without a name.
std::string PageName(PageSize page);

/// The smallest page with a name on which `needed` fits; where none does, `needed` itself rounded
/// up to whole millimetres.
PageSize FindPageFor(PageSize needed);

struct SheetMarker {
  tracker::MarkerPattern pattern;
  Vec2 top_left_mm;  ///< Of the quiet zone.
  double module_mm = 0.0;
};

struct SheetRectangle {
  Vec2 top_left_mm;
  Vec2 size_mm;
};

struct SheetTriangle {
  std::array<Vec2, 3> corners_mm;
};

/// One line of ASCII text in Helvetica or what looks like it.
struct SheetText {
  Vec2 baseline_mm;  ///< Its left end.
  double size_mm = 3.5;
  std::string text;
};

struct Sheet {
  PageSize page;
  std::string title;
  std::vector<SheetMarker> prints;
  std::vector<SheetRectangle> rectangles;
  std::vector<SheetTriangle> triangles;
  std::vector<SheetText> texts;
};

}  // namespace pleinair::exports
