#pragma once

#include <array>
#include <string_view>

namespace pleinair::tracker {

/// Geometry of an S-G marker in modules; 40 modules are the edge of the outer black square.
namespace sg {

inline constexpr int kVersion = 1;
inline constexpr int kEdge = 40;                     ///< Modules along the outer black square.
inline constexpr int kQuiet = 4;                     ///< White margin on each side.
inline constexpr int kModules = kEdge + 2 * kQuiet;  ///< Modules along the marker, margin included.
inline constexpr int kContent = 10;                  ///< First module of the content, both ways,
inline constexpr int kCells = 5;       ///< … which has so many cells along each side,
inline constexpr int kCell = 4;        ///< … each so many modules wide.
inline constexpr int kCodeCells = 24;  ///< All but the one in the middle.

/// Row or column of modules of the square → its cell, or -1.
constexpr int CellIndex(int module) {
  return module < kContent || module >= kContent + kCells * kCell ? -1
                                                                  : (module - kContent) / kCell;
}

/// Which of the 24 code cells (row-major, the middle left out) lies at `column`, `row` of the
/// cells; -1 is the cell in the middle, which is always white.
constexpr int CodeCell(int column, int row) {
  const int index = row * kCells + column;
  constexpr int kMiddle = kCells * kCells / 2;
  return index == kMiddle ? -1 : index - (index > kMiddle ? 1 : 0);
}

/// Column (or row) of a code cell: the inverse of CodeCell.
constexpr int CodeCellColumn(int code_cell) { return (code_cell + (code_cell >= 12)) % kCells; }
constexpr int CodeCellRow(int code_cell) { return (code_cell + (code_cell >= 12)) / kCells; }

/// The black square row by row from the top-left: '#' black, '.' white. What it has where the
/// content lies is not looked at.
using Border = std::array<std::string_view, kEdge>;

/// The border of version 1; frozen, since prints of it hang on walls. Found by `marker_search
/// --budget 250034 --seed 1 --views 48` (tools/marker_search): score 0.604 on views that the search
/// did not see, where a border laid out by hand has 0.567 (docs/measurements/sg-marker.md, "Border
/// layout").
// clang-format off
inline constexpr Border kBorder = {
    "########################################",
    "########################################",
    "########################################",
    "########################################",
    "#############.....####....########..####",
    "######.....##.....####....#..#..##..####",
    "######.....##....####.....#..#...#######",
    "#######....##...#####.....####.....#####",
    "#######...###...#####..#..####.....#####",
    "#######..#######################..######",
    "########################################",
    "#######..#######################...#####",
    "####..#..#######################...#####",
    "####..##################################",
    "###############################....#####",
    "####..#..######################.....####",
    "####..#..######################.....####",
    "################################....####",
    "######..########################...#####",
    "######..################################",
    "###############################...######",
    "###############################...######",
    "###############################...######",
    "#####....###############################",
    "####.....#######################....####",
    "####....#######################.....####",
    "####....#######################....#####",
    "#####..########################....#####",
    "###############################...######",
    "#####....###############################",
    "#####....#######################..######",
    "#######...##..##...#######....##...#####",
    "####..#...##..##...######.....##...#####",
    "####..#..###..########..#...############",
    "####..###########..###..#....#####..####",
    "#################..#######...#####..####",
    "########################################",
    "########################################",
    "########################################",
    "########################################",
};
// clang-format on

}  // namespace sg
}  // namespace pleinair::tracker
