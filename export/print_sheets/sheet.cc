#include "export/print_sheets/sheet.h"

#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

namespace pleinair::exports {
namespace {

struct NamedPage {
  std::string_view name;
  PageSize size;
};

// ISO 216, and the North American letter (8.5 × 11 inches); ascending within each.
constexpr NamedPage kPages[] = {
    {"A5", {148, 210}}, {"A4", {210, 297}}, {"letter", {215.9, 279.4}}, {"A3", {297, 420}},
    {"A2", {420, 594}}, {"A1", {594, 841}}, {"A0", {841, 1189}},
};
constexpr std::string_view kLandscape = "-landscape";
constexpr double kMinSide_mm = 30.0;
constexpr double kMaxSide_mm = 5000.0;  // PDF readers stop at 14,400 points, 5,080 mm.

constexpr PageSize Turned(PageSize page) { return {page.height_mm, page.width_mm}; }

/// Parses both sides of "210x297"; false for other text.
bool ParseSides(const std::string& text, PageSize* page) {
  char* end = nullptr;
  page->width_mm = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 'x') return false;
  const char* second = end + 1;
  page->height_mm = std::strtod(second, &end);
  return end != second && *end == '\0';
}

bool SideInRange(double side_mm) {  // False for NaN.
  return side_mm >= kMinSide_mm && side_mm <= kMaxSide_mm;
}

}  // namespace

Result<PageSize> ParsePageSize(const std::string& text) {
  for (const NamedPage& page : kPages) {
    if (text == page.name) return page.size;
    if (text == std::string(page.name) + std::string(kLandscape)) return Turned(page.size);
  }
  PageSize page;
  if (!ParseSides(text, &page)) {
    return InputError("--page", "there is no page \"" + text + "\"",
                      "use A5, A4, A3, A2, A1, A0 or letter, with -landscape behind it to turn it, "
                      "or WIDTHxHEIGHT in mm, for example 300x400");
  }
  if (!SideInRange(page.width_mm) || !SideInRange(page.height_mm)) {
    return InputError("--page", "a page of " + text + " mm cannot be made",
                      fmt::format("give sides from {} to {} mm", kMinSide_mm, kMaxSide_mm));
  }
  return page;
}

std::string PageName(PageSize size) {
  for (const NamedPage& page : kPages) {
    if (size == page.size) return std::string(page.name);
    if (size == Turned(page.size)) return std::string(page.name) + std::string(kLandscape);
  }
  return fmt::format("{}x{}", size.width_mm, size.height_mm);
}

PageSize FindPageFor(PageSize needed) {
  const auto fits = [&](PageSize page) {
    return needed.width_mm <= page.width_mm && needed.height_mm <= page.height_mm;
  };
  for (const NamedPage& page : kPages) {
    if (fits(page.size)) return page.size;
    if (fits(Turned(page.size))) return Turned(page.size);
  }
  return {std::ceil(needed.width_mm), std::ceil(needed.height_mm)};
}

}  // namespace pleinair::exports
