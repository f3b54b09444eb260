#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/calibrate/board_options.h"
#include "app/commands/command.h"
#include "app/options/sheet_format_options.h"
#include "base/atomic_file.h"
#include "export/print_sheets/board_description.h"
#include "export/print_sheets/marker_sheet.h"
#include "export/print_sheets/sheet.h"
#include "export/print_sheets/sheet_file.h"
#include "export/print_sheets/square_board.h"
#include "tracker/calibration/aruco_dictionaries.h"
#include "tracker/golay/golay_code.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBoardExamples =
    "Examples:\n"
    "  pleinair board -o board.pdf\n"
    "      4 x 5 markers of 36 mm on A4, and board.json, which says where each corner lies\n"
    "  pleinair board --columns 6 --rows 4 --first 100 --size-mm 50 --page A2-landscape -o "
    "big.svg\n"
    "  pleinair board --chessboard 9x6 -o chess.pdf\n"
    "      9 x 6 inner corners, squares as large as the page takes\n"
    "  pleinair board --charuco 8x6 --dictionary 5x5_100 --square-mm 30 --page A3-landscape "
    "-o charuco.svg\n"
    "A marker's size is the outer edge of its black square; the gap lies between two such edges.\n"
    "'pleinair calibrate --board board.json' reads what is written beside the sheet.\n";

struct BoardSheetOptions {
  exports::Board board{.columns = 4, .rows = 5, .first = 0, .size_mm = 36.0};
  std::optional<double> gap_mm;
  std::string chessboard, charuco, dictionary;
  std::optional<double> square_mm, marker_mm;
  std::string page = "A4";
  exports::FormatFlags formats;
  std::string output;
  std::string description;
  bool json = false;
};

Result<exports::Board> CheckBoard(const BoardSheetOptions& options) {
  exports::Board board = options.board;
  if (board.first + board.Count() > tracker::kGolayNumbers) {
    return InputError("--first",
                      fmt::format("{} markers from number {} on go beyond the last number, {}",
                                  board.Count(), board.first, tracker::kGolayNumbers - 1),
                      "start lower or print fewer");
  }
  board.gap_mm = options.gap_mm.value_or(exports::MinGap_mm(board.size_mm) * 2.0);
  if (!(board.gap_mm >= exports::MinGap_mm(board.size_mm)) ||
      board.gap_mm > exports::kMaxMarker_mm) {
    return InputError("--gap-mm",
                      fmt::format("a gap of {:g} mm leaves markers of {:g} mm without their white "
                                  "margin",
                                  board.gap_mm, board.size_mm),
                      fmt::format("give {:g} mm or more", exports::MinGap_mm(board.size_mm)));
  }
  return board;
}

/// File of the description. Beside the sheet only if that name is free.
Result<fs::path> NameDescription(const BoardSheetOptions& options) {
  if (!options.description.empty()) return fs::path(options.description);
  fs::path beside = fs::path(options.output).replace_extension(".json");
  std::error_code ignored;
  if (fs::exists(beside, ignored) && !exports::IsBoardDescription(beside)) {
    return InputError(beside.string(), "is there and is no description of a board",
                      "name another file with --description");
  }
  return beside;
}

/// The printed sheet and its description.
struct Printed {
  exports::Sheet sheet;
  std::string description;
  nlohmann::ordered_json json;  ///< Content of --json in addition to the files.
};

Result<Printed> PrintMarkers(const BoardSheetOptions& options, exports::PageSize page) {
  if (options.square_mm || options.marker_mm || !options.dictionary.empty()) {
    return InputError("--square-mm, --marker-mm and --dictionary",
                      "are for chessboards and ChArUco boards",
                      "name one with --chessboard or --charuco, or leave them out");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const exports::Board board, CheckBoard(options));
  PLEINAIR_ASSIGN_OR_RETURN(exports::Sheet sheet, exports::BoardSheet(board, page));
  return Printed{std::move(sheet),
                 exports::DescribeBoard(board),
                 {{"first", board.first}, {"count", board.Count()}}};
}

/// Side of a ChArUco board's markers: with enough white margin to decode them.
Result<double> MarkerSide_mm(const BoardSheetOptions& options, double square_mm) {
  constexpr double kUsual = 0.75, kMin = 0.4, kMax = 0.9;
  const double side = options.marker_mm.value_or(kUsual * square_mm);
  if (side >= kMin * square_mm && side <= kMax * square_mm) return side;
  return InputError(
      "--marker-mm",
      fmt::format("markers of {:g} mm do not suit squares of {:g} mm", side, square_mm),
      fmt::format("give {:g} to {:g} mm", kMin * square_mm, kMax * square_mm));
}

Result<Printed> PrintSquares(const BoardSheetOptions& options, exports::PageSize page) {
  const bool charuco = !options.charuco.empty();
  exports::SquareBoard print;
  tracker::CalibrationBoard& board = print.board;
  board.kind = charuco ? tracker::BoardKind::kCharuco : tracker::BoardKind::kChessboard;
  PLEINAIR_ASSIGN_OR_RETURN(const auto sides, charuco
                                                  ? ParseSides("--charuco", options.charuco)
                                                  : ParseSides("--chessboard", options.chessboard));
  board.columns = sides.first;
  board.rows = sides.second;
  board.square_m = 1.0;  // Until it is known.
  board.dictionary = options.dictionary;
  PLEINAIR_RETURN_IF_ERROR(tracker::CheckBoard(board));
  if (!charuco && (options.marker_mm || !options.dictionary.empty())) {
    return InputError("--marker-mm and --dictionary", "are for ChArUco boards", "leave them out");
  }
  if (charuco && board.dictionary.empty()) {
    const auto names = tracker::DictionariesFor(board.columns * board.rows / 2);
    if (names.empty()) {
      return InputError("--charuco", "has more markers than any dictionary", "print fewer squares");
    }
    board.dictionary = names.front();
  }
  double square_mm = options.square_mm.value_or(0.0);
  if (!options.square_mm) {
    PLEINAIR_ASSIGN_OR_RETURN(square_mm, exports::MaxSquare_mm(board, page));
  }
  board.square_m = square_mm * 1e-3;
  if (charuco) {
    PLEINAIR_ASSIGN_OR_RETURN(print.marker_mm, MarkerSide_mm(options, square_mm));
  }
  PLEINAIR_ASSIGN_OR_RETURN(exports::Sheet sheet, exports::SquareBoardSheet(print, page));
  nlohmann::ordered_json json{{"square_mm", square_mm}};
  if (charuco) {
    json["marker_mm"] = print.marker_mm;
    json["dictionary"] = board.dictionary;
  }
  return Printed{std::move(sheet), exports::DescribeBoard(print), std::move(json)};
}

Result<void> RunBoard(const BoardSheetOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(exports::CheckLength("--size-mm", options.board.size_mm));
  PLEINAIR_RETURN_IF_ERROR(exports::CheckLength("--gap-mm", options.gap_mm.value_or(0.0)));
  PLEINAIR_RETURN_IF_ERROR(exports::CheckLength("--square-mm", options.square_mm.value_or(0.0)));
  PLEINAIR_RETURN_IF_ERROR(exports::CheckLength("--marker-mm", options.marker_mm.value_or(0.0)));
  if (options.output.empty()) {
    return InputError("--output", "the name is empty", "name a file, for example board.pdf");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const exports::PageSize page, exports::ParsePageSize(options.page));
  PLEINAIR_ASSIGN_OR_RETURN(const exports::SheetFormat format,
                            exports::ChooseFormat(options.formats, options.output));
  const bool squares = !options.chessboard.empty() || !options.charuco.empty();
  PLEINAIR_ASSIGN_OR_RETURN(Printed printed,
                            squares ? PrintSquares(options, page) : PrintMarkers(options, page));
  PLEINAIR_ASSIGN_OR_RETURN(const std::string content, exports::RenderSheet(printed.sheet, format));
  PLEINAIR_ASSIGN_OR_RETURN(const fs::path description, NameDescription(options));
  if (description == fs::path(options.output)) {
    return InputError("--description", "names the same file as --output", "give it another name");
  }
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(description, printed.description));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(options.output, content));
  if (options.json) {
    nlohmann::ordered_json json{{"file", options.output},
                                {"description", description.string()},
                                {"page_mm", {page.width_mm, page.height_mm}}};
    json.update(printed.json);
    std::cout << json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  }
  return {};
}

}  // namespace

void AddBoardCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<BoardSheetOptions>();
  CLI::App* command = app.add_subcommand(
      "board", "Make a board to print: of markers, or a chessboard or ChArUco board");
  command->footer(kBoardExamples);
  const auto side = CLI::Range(1, tracker::kGolayNumbers);
  std::vector<CLI::Option*> of_markers;
  of_markers.push_back(
      command->add_option("--columns", options->board.columns, "Markers side by side")
          ->check(side)
          ->capture_default_str());
  of_markers.push_back(
      command->add_option("--rows", options->board.rows, "Markers one below the other")
          ->check(side)
          ->capture_default_str());
  of_markers.push_back(
      command
          ->add_option("--first", options->board.first,
                       "Number of the top-left marker; the others follow row by row")
          ->check(CLI::Range(0, tracker::kGolayNumbers - 1))
          ->capture_default_str());
  of_markers.push_back(
      command->add_option("--size-mm", options->board.size_mm, "Outer edge of each black square")
          ->type_name("MM")
          ->check(CLI::Range(exports::kMinMarker_mm, exports::kMaxMarker_mm))
          ->capture_default_str());
  of_markers.push_back(
      command
          ->add_option("--gap-mm", options->gap_mm,
                       "Between the black squares; default 0.2, at least 0.1 of the size")
          ->type_name("MM"));
  CLI::Option* chessboard = command
                                ->add_option("--chessboard", options->chessboard,
                                             "A chessboard instead, with this many inner corners")
                                ->type_name("9x6");
  CLI::Option* charuco = command
                             ->add_option("--charuco", options->charuco,
                                          "A ChArUco board instead, of this many squares")
                             ->type_name("8x6")
                             ->excludes(chessboard);
  for (CLI::Option* option : of_markers) option->excludes(chessboard)->excludes(charuco);
  command
      ->add_option("--dictionary", options->dictionary,
                   "Of the ChArUco board's markers, such as 5x5_100; default: the smallest of 4x4")
      ->type_name("NAME");
  command
      ->add_option("--square-mm", options->square_mm,
                   "Side of a square; default: the most whole millimetres that fit the page")
      ->check(CLI::Range(exports::kMinMarker_mm, exports::kMaxMarker_mm))
      ->type_name("MM");
  command
      ->add_option("--marker-mm", options->marker_mm,
                   "Side of a ChArUco marker's black square; default 0.75 of a square")
      ->check(CLI::Range(1.0, exports::kMaxMarker_mm))
      ->type_name("MM");
  command->add_option("--page", options->page, "A5 to A0, letter, A4-landscape or 300x400 in mm")
      ->type_name("PAGE")
      ->capture_default_str();
  AddFormatOptions(*command, options->formats);
  command->add_option("-o,--output", options->output, "File (.pdf, .svg, .png)")
      ->type_name("F")
      ->required();
  command
      ->add_option("--description", options->description,
                   "Where the corners lie, as JSON; default: the output with the ending .json")
      ->type_name("F");
  command->add_flag("--json", options->json, "One JSON object on standard output");
  command->callback([options, &result] { result.status = RunBoard(*options); });
}

}  // namespace pleinair::app
