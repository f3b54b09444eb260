#include "export/print_sheets/square_board.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "export/print_sheets/board_description.h"
#include "export/print_sheets/marker_sheet.h"
#include "export/print_sheets/sheet_legend.h"
#include "tracker/calibration/aruco_dictionaries.h"

namespace pleinair::exports {
namespace {

using tracker::BoardKind;
using tracker::CalibrationBoard;

// White margin around the board, in squares: required by OpenCV's chessboard detector.
constexpr double kMargin = 0.5;
constexpr double kMinSquare_mm = 4.0;

struct Sides {
  int columns = 0, rows = 0;
};

/// Number of squares; chessboards count their inner corners.
Sides SquaresOf(const CalibrationBoard& board) {
  const int more = board.kind == BoardKind::kChessboard ? 1 : 0;
  return {board.columns + more, board.rows + more};
}

Vec2 AreaOf(const CalibrationBoard& board, double square_mm) {
  const Sides squares = SquaresOf(board);
  return Vec2{squares.columns + 2.0 * kMargin, squares.rows + 2.0 * kMargin} * square_mm;
}

std::string Title(const CalibrationBoard& board) {
  if (board.kind == BoardKind::kCharuco) {
    return fmt::format("ChArUco board {}x{} squares, {}", board.columns, board.rows,
                       board.dictionary);
  }
  return fmt::format("Chessboard {}x{} inner corners", board.columns, board.rows);
}

SheetLegend LegendOf(const SquareBoard& board, double square_mm) {
  const CalibrationBoard& b = board.board;
  std::string sizes = fmt::format("squares of {:g} mm", square_mm);
  if (b.kind == BoardKind::kCharuco) sizes += fmt::format(", markers of {:g} mm", board.marker_mm);
  return {fmt::format("a board of {}x{} squares of {:g} mm", SquaresOf(b).columns,
                      SquaresOf(b).rows, square_mm),
          "--square-mm",
          square_mm,
          {Title(b), sizes, kHowToPrint, kHowToMount}};
}

/// The black squares. Marker patterns are square; the rest of the pattern is white.
tracker::MarkerPattern Squares(Sides squares) {
  tracker::MarkerPattern print;
  print.modules = print.edge_modules = std::max(squares.columns, squares.rows);
  print.white.assign(static_cast<std::size_t>(print.modules) * print.modules, 1);
  for (int row = 0; row < squares.rows; ++row) {
    for (int column = row % 2; column < squares.columns; column += 2) {
      print.white[static_cast<std::size_t>(row) * print.modules + column] = 0;
    }
  }
  return print;
}

}  // namespace

Result<double> MaxSquare_mm(const CalibrationBoard& board, PageSize page) {
  // The legend's size hardly depends on the squares.
  const auto fits = [&](double square_mm) {
    return CheckFit(LegendOf({board, square_mm}, square_mm), AreaOf(board, square_mm), page);
  };
  double square_mm = std::floor(std::max(page.width_mm, page.height_mm));
  while (square_mm > kMinSquare_mm && !fits(square_mm)) square_mm -= 1.0;
  PLEINAIR_RETURN_IF_ERROR(fits(square_mm));
  return square_mm;
}

Result<Sheet> SquareBoardSheet(const SquareBoard& board, PageSize page) {
  const CalibrationBoard& b = board.board;
  const double square_mm = b.square_m * 1e3;
  const SheetLegend legend = LegendOf(board, square_mm);
  const Vec2 area = AreaOf(b, square_mm);
  PLEINAIR_RETURN_IF_ERROR(CheckFit(legend, area, page));
  Sheet sheet;
  sheet.page = page;
  sheet.title = Title(b);
  const Vec2 top_left = PlaceArea(area, page);
  const double quiet_mm = kMargin * square_mm;
  const Vec2 first = top_left + Vec2{quiet_mm, quiet_mm};
  const Sides squares = SquaresOf(b);
  sheet.prints.push_back({Squares(squares), first, square_mm});
  if (b.kind == BoardKind::kCharuco) {
    int id = 0;
    for (int row = 0; row < squares.rows; ++row) {
      for (int column = 1 - row % 2; column < squares.columns; column += 2) {
        PLEINAIR_ASSIGN_OR_RETURN(tracker::MarkerPattern code,
                                  tracker::ArucoMarkerPattern(b.dictionary, id++));
        const double margin_mm = 0.5 * (square_mm - board.marker_mm);
        const double module_mm = board.marker_mm / code.modules;
        sheet.prints.push_back(
            {std::move(code),
             first + Vec2{column * square_mm + margin_mm, row * square_mm + margin_mm}, module_mm});
      }
    }
  }
  AddLegend(&sheet, legend, top_left, area, quiet_mm);
  return sheet;
}

std::string DescribeBoard(const SquareBoard& board) {
  const CalibrationBoard& b = board.board;
  const bool charuco = b.kind == BoardKind::kCharuco;
  nlohmann::ordered_json description = {{"format", 1},
                                        {"family", charuco ? "charuco" : "chessboard"},
                                        {"columns", b.columns},
                                        {"rows", b.rows},
                                        {"square_m", RoundedMetres(b.square_m * 1e3)}};
  if (charuco) {
    description["dictionary"] = b.dictionary;
    description["marker_size_m"] = RoundedMetres(board.marker_mm);
  }
  for (const Vec2 corner : tracker::BoardPoints(b)) {
    description["corners_m"].push_back(
        {RoundedMetres(corner.x * 1e3), RoundedMetres(corner.y * 1e3), 0.0});
  }
  return description.dump(1) + '\n';
}

}  // namespace pleinair::exports
