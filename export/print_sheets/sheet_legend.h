#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "export/print_sheets/sheet.h"

namespace pleinair::exports {

/// What is the same on every page: prints in the middle, and everything about them below: a
/// dimension arrow, a 100 mm ruler, and how to print it. Crop marks outside the white margin.
struct SheetLegend {
  std::string what;                ///< "a marker of 140 mm".
  std::string option;              ///< That makes it smaller.
  double dimension_mm = 0.0;       ///< Edge that the arrow measures, from the prints' left end on.
  std::vector<std::string> lines;  ///< Below the ruler.
};

// Hardly wider than the ruler, so that small pages do.
inline constexpr const char* kHowToPrint = "Print at 100 % (actual size); check the ruler.";
inline constexpr const char* kHowToMount = "Leave the white margin on it; mount it flat.";

/// The page that holds an area (prints with their white margin) and its legend.
PageSize PageNeeded(const SheetLegend& legend, Vec2 area_mm);

/// Error (input): it does not fit, with a page that would do.
Result<void> CheckFit(const SheetLegend& legend, Vec2 area_mm, PageSize page);

/// Top-left corner of the prints' area, on whole millimetres.
Vec2 PlaceArea(Vec2 area_mm, PageSize page);

/// `quiet_mm`: width of the white margin within the area.
void AddLegend(Sheet* sheet, const SheetLegend& legend, Vec2 area_top_left_mm, Vec2 area_mm,
               double quiet_mm);

}  // namespace pleinair::exports
