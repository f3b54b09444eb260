#include "app/sheets/marker_sheet.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_print.h"

namespace pleinair::app {
namespace {

namespace sg = tracker::sg;

// Common printers leave up to 5 mm of the paper white; the crop marks need 4 mm more.
constexpr double kMargin_mm = 10.0;
constexpr double kLine_mm = 0.2;
constexpr double kTextSize_mm = 3.5;
constexpr double kTextLine_mm = 5.0;
constexpr double kRuler_mm = 100.0;
// Below the prints: dimension arrow 6, its label 5, ruler 9, then text.
constexpr double kDimensionHeight_mm = 11.0;
constexpr double kRulerHeight_mm = 11.0;

void AddLine(Sheet* sheet, Vec2 from, Vec2 to) {
  const double left = std::min(from.x, to.x), top = std::min(from.y, to.y);
  const double width = std::abs(to.x - from.x), height = std::abs(to.y - from.y);
  // One of the two is 0: lines stand upright or lie, and their middle is the place named.
  const Vec2 thickness{width == 0.0 ? kLine_mm : 0.0, height == 0.0 ? kLine_mm : 0.0};
  sheet->rectangles.push_back({Vec2{left, top} - thickness * 0.5, Vec2{width, height} + thickness});
}

/// Arrow between two upright lines that stand at the ends of what it measures.
void AddDimension(Sheet* sheet, double left, double right, double top) {
  constexpr double kHeadLength_mm = 3.0, kHeadHalfWidth_mm = 0.7;
  const double y = top + 3.0;
  const double head = std::min(kHeadLength_mm, 0.4 * (right - left));
  AddLine(sheet, {left, top}, {left, top + 5.0});
  AddLine(sheet, {right, top}, {right, top + 5.0});
  AddLine(sheet, {left, y}, {right, y});
  for (const auto& [tip, back] : {std::pair{left, left + head}, {right, right - head}}) {
    sheet->triangles.push_back(
        {{Vec2{tip, y}, Vec2{back, y - kHeadHalfWidth_mm}, Vec2{back, y + kHeadHalfWidth_mm}}});
  }
}

void AddRuler(Sheet* sheet, Vec2 top_left) {
  const double bottom = top_left.y + 5.0;
  AddLine(sheet, {top_left.x, bottom}, {top_left.x + kRuler_mm, bottom});
  for (int mm = 0; mm <= static_cast<int>(kRuler_mm); ++mm) {
    const double length = mm % 10 == 0 ? 5.0 : mm % 5 == 0 ? 3.5 : 2.0;
    AddLine(sheet, {top_left.x + mm, bottom - length}, {top_left.x + mm, bottom});
  }
  sheet->texts.push_back({{top_left.x, bottom + 4.0}, 3.0, "0"});
  sheet->texts.push_back({{top_left.x + 45.0, bottom + 4.0}, 3.0, "50 mm"});
  sheet->texts.push_back({{top_left.x + 88.0, bottom + 4.0}, 3.0, "100 mm"});
}

/// Where to cut: outside the white margin, which belongs to the marker.
void AddCropMarks(Sheet* sheet, Vec2 top_left, Vec2 bottom_right) {
  constexpr double kAway_mm = 1.0, kLength_mm = 3.0;
  for (const double x : {top_left.x, bottom_right.x}) {
    const double out = x == top_left.x ? -1.0 : 1.0;
    for (const double y : {top_left.y, bottom_right.y}) {
      const double away = y == top_left.y ? -1.0 : 1.0;
      AddLine(sheet, {x + out * kAway_mm, y}, {x + out * (kAway_mm + kLength_mm), y});
      AddLine(sheet, {x, y + away * kAway_mm}, {x, y + away * (kAway_mm + kLength_mm)});
    }
  }
}

SheetPrint PlacePrint(int number, double size_mm, Vec2 centre) {
  const double module_mm = size_mm / sg::kEdge;
  const double half = 0.5 * sg::kPrint * module_mm;
  return {tracker::SgPrint(number), centre - Vec2{half, half}, module_mm};
}

/// What is the same on every page: prints in the middle, and everything about them below.
struct Legend {
  std::string what;                // "marker 140 mm".
  double dimension_mm = 0.0;       // Edge that the arrow measures, from the prints' left end on.
  std::vector<std::string> lines;  // Below the ruler.
};

constexpr double kFooterGap_mm = 5.0;

double LegendHeight(const Legend& legend) {
  return kFooterGap_mm + kDimensionHeight_mm + kRulerHeight_mm +
         kTextLine_mm * static_cast<double>(legend.lines.size());
}

/// Helvetica's letters are half as wide as its size on average, and few lines exceed 0.55.
double WidestLine(const Legend& legend) {
  std::size_t longest = 0;
  for (const std::string& line : legend.lines) longest = std::max(longest, line.size());
  return 0.55 * kTextSize_mm * static_cast<double>(longest);
}

/// Says which page would do where `area` (prints with their white margin) does not fit.
Result<void> CheckFit(const Legend& legend, Vec2 area, PageSize page) {
  const double widest = std::max({area.x, kRuler_mm, WidestLine(legend)});
  const PageSize needed{widest + 2.0 * kMargin_mm,
                        area.y + LegendHeight(legend) + 2.0 * kMargin_mm};
  if (needed.width_mm <= page.width_mm && needed.height_mm <= page.height_mm) return {};
  return InputError(
      "--size-mm",
      fmt::format("{} with its white margin and legend needs {:.0f} x {:.0f} mm, and the page has "
                  "{} x {}",
                  legend.what, std::ceil(needed.width_mm), std::ceil(needed.height_mm),
                  page.width_mm, page.height_mm),
      fmt::format("print it smaller or with --page {}", PageName(FindPageFor(needed))));
}

/// Top-left corner of the prints' area, on whole millimetres.
Vec2 PlaceArea(Vec2 area, PageSize page) {
  return {std::floor(0.5 * (page.width_mm - area.x)), kMargin_mm};
}

void AddLegend(Sheet* sheet, const Legend& legend, Vec2 area_top_left, Vec2 area, double quiet_mm) {
  AddCropMarks(sheet, area_top_left, area_top_left + area);
  double y = area_top_left.y + area.y + kFooterGap_mm;
  const double edge_left = area_top_left.x + quiet_mm;
  AddDimension(sheet, edge_left, edge_left + legend.dimension_mm, y);
  sheet->texts.push_back(
      {{edge_left, y + 9.0}, kTextSize_mm, fmt::format("{:g} mm", legend.dimension_mm)});
  y += kDimensionHeight_mm;
  // Text and ruler start at the prints' left end where they fit there.
  const double widest = std::max(kRuler_mm, WidestLine(legend));
  const double left =
      std::min(area_top_left.x, std::max(kMargin_mm, 0.5 * (sheet->page.width_mm - widest)));
  AddRuler(sheet, {left, y});
  y += kRulerHeight_mm;
  for (const std::string& line : legend.lines) {
    y += kTextLine_mm;
    sheet->texts.push_back({{left, y}, kTextSize_mm, line});
  }
}

// Hardly wider than the ruler, so that small pages do.
constexpr const char* kSizeDefinition = "Size: the outer edge of the black square.";
constexpr const char* kHowToPrint = "Print at 100 % (actual size); check the ruler.";
constexpr const char* kHowToMount = "Leave the white margin on it; mount it flat.";

}  // namespace

Result<Sheet> MarkerSheet(int number, double size_mm, PageSize page) {
  Sheet sheet;
  sheet.page = page;
  sheet.title = fmt::format("S-G marker {}, {:g} mm", number, size_mm);
  const Legend legend{
      fmt::format("a marker of {:g} mm", size_mm),
      size_mm,
      {fmt::format("S-G marker {}   version {}   {:g} mm", number, sg::kVersion, size_mm),
       kSizeDefinition, kHowToPrint, kHowToMount}};
  const double quiet_mm = size_mm * sg::kQuiet / sg::kEdge;
  const Vec2 area{size_mm + 2.0 * quiet_mm, size_mm + 2.0 * quiet_mm};
  PLEINAIR_RETURN_IF_ERROR(CheckFit(legend, area, page));
  const Vec2 top_left = PlaceArea(area, page);
  sheet.prints.push_back(PlacePrint(number, size_mm, top_left + area * 0.5));
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
  const Legend legend{
      fmt::format("a board of {} x {} markers of {:g} mm, {:g} mm apart,", board.columns,
                  board.rows, board.size_mm, board.gap_mm),
      board.size_mm,
      {fmt::format("S-G board {}   version {}   {} x {} of {:g} mm, gap {:g} mm", numbers,
                   sg::kVersion, board.columns, board.rows, board.size_mm, board.gap_mm),
       kSizeDefinition, kHowToPrint, kHowToMount}};
  const double quiet_mm = board.size_mm * sg::kQuiet / sg::kEdge;
  const Vec2 area{board.Width_mm() + 2.0 * quiet_mm, board.Height_mm() + 2.0 * quiet_mm};
  PLEINAIR_RETURN_IF_ERROR(CheckFit(legend, area, page));
  const Vec2 top_left = PlaceArea(area, page);
  const Vec2 middle = top_left + area * 0.5;
  for (int i = 0; i < board.Count(); ++i) {
    const Vec2 centre = board.Centre_mm(i);
    sheet.prints.push_back(
        PlacePrint(board.first + i, board.size_mm, middle + Vec2{centre.x, -centre.y}));
  }
  AddLegend(&sheet, legend, top_left, area, quiet_mm);
  return sheet;
}

CornersOnPage FindCorners(const SheetPrint& print) {
  const int quiet = (print.pattern.modules - print.pattern.edge_modules) / 2;
  const double edge_mm = print.pattern.edge_modules * print.module_mm;
  const Vec2 first = print.top_left_mm + Vec2{1.0, 1.0} * (quiet * print.module_mm);
  return {first, first + Vec2{edge_mm, 0.0}, first + Vec2{edge_mm, edge_mm},
          first + Vec2{0.0, edge_mm}};
}

}  // namespace pleinair::app
