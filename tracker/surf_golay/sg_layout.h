#pragma once

#include <array>
#include <string_view>

namespace pleinair::tracker {

/// Geometry of an S-G marker in modules; the outer black square is 40 modules wide.
namespace sg {

inline constexpr int kVersion = 1;
inline constexpr int kEdge = 40;                     ///< Modules along the outer black square.
inline constexpr int kQuiet = 4;                     ///< White margin on each side.
inline constexpr int kModules = kEdge + 2 * kQuiet;  ///< Modules along the marker, margin included.
inline constexpr int kContent = 10;    ///< First module of the content, in both directions,
inline constexpr int kCells = 5;       ///< … which has this many cells along each side,
inline constexpr int kCell = 4;        ///< … each this many modules wide.
inline constexpr int kCodeCells = 24;  ///< All but the centre cell.

/// Cell index of a row or column of modules of the square, or -1.
constexpr int CellIndex(int module) {
  return module < kContent || module >= kContent + kCells * kCell ? -1
                                                                  : (module - kContent) / kCell;
}

/// Index of the code cell (row-major, centre cell left out) at `column`, `row` of the cells; -1 for
/// the centre cell, which is always white.
constexpr int CodeCell(int column, int row) {
  const int index = row * kCells + column;
  constexpr int kMiddle = kCells * kCells / 2;
  return index == kMiddle ? -1 : index - (index > kMiddle ? 1 : 0);
}

/// Column (or row) of a code cell: the inverse of CodeCell().
constexpr int CodeCellColumn(int code_cell) { return (code_cell + (code_cell >= 12)) % kCells; }
constexpr int CodeCellRow(int code_cell) { return (code_cell + (code_cell >= 12)) / kCells; }

/// The black square row by row from the top-left: '#' black, '.' white. Its values in the content
/// area are not used.
using Border = std::array<std::string_view, kEdge>;

/// The border of version 1; frozen, because printed markers are in use. Result of `marker_search
/// --budget 250034 --seed 1 --views 48` (tools/marker_search): score 0.604 on held-out views, where
/// a border designed by hand has 0.567 (docs/measurements/sg-marker.md, "Border layout").
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
