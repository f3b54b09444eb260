#include "tracker/surf_golay/sg_marker_pattern.h"

#include "base/check.h"
#include "tracker/golay/golay_code.h"

namespace pleinair::tracker {

MarkerPattern SgMarkerPattern(int number) {
  return SgMarkerPatternOfWord(CodewordOfNumber(number));
}

MarkerPattern SgMarkerPatternOfWord(std::uint32_t word, const sg::Border& border) {
  MarkerPattern pattern;
  pattern.modules = sg::kModules;
  pattern.edge_modules = sg::kEdge;
  pattern.unknown_first = sg::kQuiet + sg::kContent;
  pattern.unknown_modules = sg::kCells * sg::kCell;
  pattern.white.assign(static_cast<std::size_t>(sg::kModules) * sg::kModules, 1);
  for (int y = 0; y < sg::kEdge; ++y) {
    for (int x = 0; x < sg::kEdge; ++x) {
      bool white = border[y][x] == '.';
      const int column = sg::CellIndex(x), row = sg::CellIndex(y);
      if (column >= 0 && row >= 0) {
        const int cell = sg::CodeCell(column, row);
        white = cell < 0 || (word >> cell & 1U) != 0;
      }
      pattern.white[(y + sg::kQuiet) * sg::kModules + x + sg::kQuiet] = white ? 1 : 0;
    }
  }
  return pattern;
}

}  // namespace pleinair::tracker
