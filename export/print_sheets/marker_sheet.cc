#include "export/print_sheets/marker_sheet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "export/print_sheets/sheet_legend.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::exports {
namespace {

namespace sg = tracker::sg;

SheetMarker PlaceMarkerOnSheet(int number, double size_mm, Vec2 centre) {
  const double module_mm = size_mm / sg::kEdge;
  const double half = 0.5 * sg::kModules * module_mm;
  return {tracker::SgMarkerPattern(number), centre - Vec2{half, half}, module_mm};
}

constexpr const char* kSizeDefinition = "Size: the outer edge of the black square.";

}  // namespace

Result<void> CheckLength(const std::string& option, double length_mm) {
  if (!std::isnan(length_mm)) return {};
  return InputError(option, "\"nan\" is no length", "give it in millimetres");
}

Result<Sheet> MarkerSheet(int number, double size_mm, PageSize page) {
  Sheet sheet;
  sheet.page = page;
  sheet.title = fmt::format("S-G marker {}, {:g} mm", number, size_mm);
  const SheetLegend legend{
      fmt::format("a marker of {:g} mm", size_mm),
      "--size-mm",
      size_mm,
      {fmt::format("S-G marker {}   version {}   {:g} mm", number, sg::kVersion, size_mm),
       kSizeDefinition, kHowToPrint, kHowToMount}};
  const double quiet_mm = size_mm * sg::kQuiet / sg::kEdge;
  const double side_mm = size_mm + 2.0 * quiet_mm;
  const SheetLabel label{fmt::format("top    S-G {}    {:g} mm", number, size_mm), side_mm};
  const Vec2 area{side_mm, side_mm + label.Height_mm()};
  PLEINAIR_RETURN_IF_ERROR(CheckFit(legend, area, page));
  const Vec2 top_left = PlaceArea(area, page);
  AddLabel(&sheet, label, top_left);
  const Vec2 middle = top_left + Vec2{0.5 * side_mm, label.Height_mm() + 0.5 * side_mm};
  sheet.prints.push_back(PlaceMarkerOnSheet(number, size_mm, middle));
  AddLegend(&sheet, legend, top_left, area, quiet_mm);
  return sheet;
}

Vec2 Board::Centre_mm(int i) const {
  const int column = i % columns, row = i / columns;
  return Vec2{column - 0.5 * (columns - 1), 0.5 * (rows - 1) - row} * (size_mm + gap_mm);
}

Result<Sheet> BoardSheet(const Board& board, PageSize page) {
  Sheet sheet;
  sheet.page = page;
  const std::string numbers = fmt::format("{} to {}", board.first, board.first + board.Count() - 1);
  sheet.title = fmt::format("S-G board {}", numbers);
  const SheetLegend legend{
      fmt::format("a board of {} x {} markers of {:g} mm, {:g} mm apart,", board.columns,
                  board.rows, board.size_mm, board.gap_mm),
      "--size-mm",
      board.size_mm,
      {fmt::format("S-G board {}   version {}   {} x {} of {:g} mm, gap {:g} mm", numbers,
                   sg::kVersion, board.columns, board.rows, board.size_mm, board.gap_mm),
       kSizeDefinition, kHowToPrint, kHowToMount}};
  const double quiet_mm = board.size_mm * sg::kQuiet / sg::kEdge;
  const Vec2 markers{board.Width_mm() + 2.0 * quiet_mm, board.Height_mm() + 2.0 * quiet_mm};
  const SheetLabel label{
      fmt::format("top    S-G {}    {:g} mm    gap {:g} mm", numbers, board.size_mm, board.gap_mm),
      markers.x};
  const Vec2 area{markers.x, markers.y + label.Height_mm()};
  PLEINAIR_RETURN_IF_ERROR(CheckFit(legend, area, page));
  const Vec2 top_left = PlaceArea(area, page);
  AddLabel(&sheet, label, top_left);
  const Vec2 middle = top_left + Vec2{0.5 * markers.x, label.Height_mm() + 0.5 * markers.y};
  for (int i = 0; i < board.Count(); ++i) {
    const Vec2 centre = board.Centre_mm(i);
    sheet.prints.push_back(
        PlaceMarkerOnSheet(board.first + i, board.size_mm, middle + Vec2{centre.x, -centre.y}));
  }
  AddLegend(&sheet, legend, top_left, area, quiet_mm);
  return sheet;
}

CornersOnPage FindCorners(const SheetMarker& print) {
  const int quiet = (print.pattern.modules - print.pattern.edge_modules) / 2;
  const double edge_mm = print.pattern.edge_modules * print.module_mm;
  const Vec2 first = print.top_left_mm + Vec2{1.0, 1.0} * (quiet * print.module_mm);
  return {first, first + Vec2{edge_mm, 0.0}, first + Vec2{edge_mm, edge_mm},
          first + Vec2{0.0, edge_mm}};
}

}  // namespace pleinair::exports
