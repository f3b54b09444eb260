#include "tools/marker_search/layout_image.h"

#include <fmt/format.h>

namespace pleinair::marker_search {

std::string DrawSvg(const tracker::MarkerPattern& print) {
  const int side = print.modules;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" width=\"480\" "
      "height=\"480\" shape-rendering=\"crispEdges\">\n"
      "<path fill=\"#fff\" d=\"M0 0h{0}v{0}H0z\"/>\n<path d=\"",
      side);
  // Merges runs of black modules with equal runs in the rows below, so that no hairlines appear.
  std::vector<std::uint8_t> white = print.white;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto run_is_black = [&](int row, int end) {
        for (int i = x; i < end; ++i) {
          if (white[row * side + i] != 0) return false;
        }
        return true;
      };
      if (white[y * side + x] != 0) continue;
      int end = x + 1, bottom = y + 1;
      while (end < side && white[y * side + end] == 0) ++end;
      while (bottom < side && run_is_black(bottom, end)) ++bottom;
      for (int row = y; row < bottom; ++row) {
        for (int i = x; i < end; ++i) white[row * side + i] = 1;
      }
      svg += fmt::format("M{} {}h{}v{}h{}z", x, y, end - x, bottom - y, x - end);
    }
  }
  return svg + "\"/>\n</svg>\n";
}

std::string WriteRows(const tracker::sg::Border& border) {
  std::string rows;
  for (std::size_t y = 0; y < border.size(); ++y) {
    rows +=
        fmt::format("{}\"{}\",{}", y % 2 == 0 ? "    " : " ", border[y], y % 2 == 1 ? "\n" : "");
  }
  return rows;
}

}  // namespace pleinair::marker_search
