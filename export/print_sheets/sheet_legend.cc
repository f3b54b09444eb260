#include "export/print_sheets/sheet_legend.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace pleinair::exports {
namespace {

// Common printers cannot print the outer 5 mm of the paper; crop marks need 4 mm more.
constexpr double kMargin_mm = 10.0;
constexpr double kLine_mm = 0.2;
constexpr double kTextSize_mm = 3.5;
constexpr double kTextLine_mm = 5.0;
// The mean letter width of Helvetica is half its size; few lines exceed 0.55.
constexpr double kLetterWidth = 0.55;
constexpr double kRuler_mm = 100.0;
// Below the markers: dimension arrow 6, its label 5, ruler 9, then text.
constexpr double kDimensionHeight_mm = 11.0;
constexpr double kRulerHeight_mm = 11.0;

void AddLine(Sheet* sheet, Vec2 from, Vec2 to) {
  const double left = std::min(from.x, to.x), top = std::min(from.y, to.y);
  const double width = std::abs(to.x - from.x), height = std::abs(to.y - from.y);
  // One of the two is 0: the line is vertical or horizontal, and the given place is its middle.
  const Vec2 thickness{width == 0.0 ? kLine_mm : 0.0, height == 0.0 ? kLine_mm : 0.0};
  sheet->rectangles.push_back({Vec2{left, top} - thickness * 0.5, Vec2{width, height} + thickness});
}

/// Arrow between two vertical lines at the ends of the measured edge.
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

/// Crop marks: outside the white margin, which belongs to the marker.
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

constexpr double kFooterGap_mm = 5.0;

double LegendHeight(const SheetLegend& legend) {
  return kFooterGap_mm + kDimensionHeight_mm + kRulerHeight_mm +
         kTextLine_mm * static_cast<double>(legend.lines.size());
}

double WidestLine(const SheetLegend& legend) {
  std::size_t longest = 0;
  for (const std::string& line : legend.lines) longest = std::max(longest, line.size());
  return kLetterWidth * kTextSize_mm * static_cast<double>(longest);
}

}  // namespace

double SheetLabel::TextSize_mm() const {
  constexpr double kLabelText_mm = 3.0;
  return std::min(
      kLabelText_mm,
      width_mm / (kLetterWidth * static_cast<double>(std::max<std::size_t>(1, text.size()))));
}

double SheetLabel::Height_mm() const { return std::ceil(1.5 * TextSize_mm()); }

void AddLabel(Sheet* sheet, const SheetLabel& label, Vec2 area_top_left) {
  const double size = label.TextSize_mm();
  // Descenders take a quarter of the size.
  sheet->texts.push_back({area_top_left + Vec2{0.0, 1.1 * size}, size, label.text});
}

PageSize PageNeeded(const SheetLegend& legend, Vec2 area) {
  const double widest = std::max({area.x, kRuler_mm, WidestLine(legend)});
  return {widest + 2.0 * kMargin_mm, area.y + LegendHeight(legend) + 2.0 * kMargin_mm};
}

Result<void> CheckFit(const SheetLegend& legend, Vec2 area, PageSize page) {
  const PageSize needed = PageNeeded(legend, area);
  if (needed.width_mm <= page.width_mm && needed.height_mm <= page.height_mm) return {};
  return InputError(
      legend.option,
      fmt::format("{} with its white margin and legend needs {:.0f} x {:.0f} mm, and the page has "
                  "{} x {}",
                  legend.what, std::ceil(needed.width_mm), std::ceil(needed.height_mm),
                  page.width_mm, page.height_mm),
      fmt::format("print it smaller or with --page {}", PageName(FindPageFor(needed))));
}

Vec2 PlaceArea(Vec2 area, PageSize page) {
  return {std::floor(0.5 * (page.width_mm - area.x)), kMargin_mm};
}

void AddLegend(Sheet* sheet, const SheetLegend& legend, Vec2 area_top_left, Vec2 area,
               double quiet_mm) {
  AddCropMarks(sheet, area_top_left, area_top_left + area);
  double y = area_top_left.y + area.y + kFooterGap_mm;
  const double edge_left = area_top_left.x + quiet_mm;
  AddDimension(sheet, edge_left, edge_left + legend.dimension_mm, y);
  sheet->texts.push_back(
      {{edge_left, y + 9.0}, kTextSize_mm, fmt::format("{:g} mm", legend.dimension_mm)});
  y += kDimensionHeight_mm;
  // Text and ruler start at the left end of the markers, if they fit.
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

}  // namespace pleinair::exports
