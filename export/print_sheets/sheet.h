#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "tracker/marker_pattern.h"

namespace pleinair::exports {

// Content of one printed page, in millimetres from the page's top-left corner, x right, y down. It
// is black on white; renderers (vector_page.h, sheet_raster.h) draw it true to scale.

struct PageSize {
  double width_mm = 210.0;
  double height_mm = 297.0;
  bool operator==(const PageSize&) const = default;
};

/// Parses "A4" (also A0…A5, letter), upright; "A4-landscape"; or "WIDTHxHEIGHT" in mm, 30 to 5000 a
/// side. Errors (input): other text.
Result<PageSize> ParsePageSize(const std::string& text);

/// "A4-landscape", or "300x400" for a size without a name.
std::string PageName(PageSize page);

/// Returns the smallest named page that `needed` fits. If there is none, returns `needed` rounded
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

/// One line of ASCII text in Helvetica or a similar font.
struct SheetText {
  Vec2 baseline_mm;  ///< Left end.
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
