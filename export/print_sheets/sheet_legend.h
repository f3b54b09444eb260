#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

/// Common layout of all pages. Above the markers is a label, which stays on a trimmed sheet. Below
/// them are a dimension arrow, a 100 mm ruler and printing instructions. Crop marks lie outside the
/// white margin.
struct SheetLegend {
  std::string what;           ///< "a marker of 140 mm".
  std::string option;         ///< Option that makes it smaller.
  double dimension_mm = 0.0;  ///< Edge of the dimension arrow, from the left end of the markers.
  std::vector<std::string> lines;  ///< Below the ruler.
};

// Short enough for small pages: hardly wider than the ruler.
inline constexpr const char* kHowToPrint = "Print at 100 % (actual size); check the ruler.";
inline constexpr const char* kHowToMount = "Leave the white margin on it; mount it flat.";

/// Label between the crop marks, above the white margin: "top" and what the marker is. A trimmed
/// sheet keeps it, and the white margin stays free. The text shrinks to the width.
struct SheetLabel {
  std::string text;
  double width_mm = 0.0;  ///< Width of the markers' area.
  /// Font size: 3 mm, or less where the text would exceed the width.
  double TextSize_mm() const;
  /// Height of the strip above the white margin, whole millimetres.
  double Height_mm() const;
};

/// The page size for an area (markers with their white margin) and its legend.
PageSize PageNeeded(const SheetLegend& legend, Vec2 area_mm);

/// Error (input): it does not fit; the error names a page that does.
Result<void> CheckFit(const SheetLegend& legend, Vec2 area_mm, PageSize page);

/// Top-left corner on the page, on whole millimetres, of an area: label strip and markers.
Vec2 PlaceArea(Vec2 area_mm, PageSize page);

void AddLabel(Sheet* sheet, const SheetLabel& label, Vec2 area_top_left_mm);

/// `quiet_mm`: width of the white margin within the area.
void AddLegend(Sheet* sheet, const SheetLegend& legend, Vec2 area_top_left_mm, Vec2 area_mm,
               double quiet_mm);

}  // namespace pleinair::exports
