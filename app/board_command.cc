#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/sheets/board_description.h"
#include "app/sheets/marker_sheet.h"
#include "app/sheets/sheet.h"
#include "app/sheets/sheet_file.h"
#include "tracker/golay/golay_code.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "Examples:\n"
    "  pleinair board -o board.pdf\n"
    "      4 x 5 markers of 36 mm on A4, and board.json, which says where each corner lies\n"
    "  pleinair board --columns 6 --rows 4 --first 100 --size-mm 50 --page A3-landscape -o "
    "big.svg\n"
    "The size is the outer edge of each black square, the gap lies between two such edges.\n";

struct Options {
  Board board{.columns = 4, .rows = 5, .first = 0, .size_mm = 36.0};
  std::optional<double> gap_mm;
  std::string page = "A4";
  FormatFlags formats;
  std::string output;
  std::string description;
  bool json = false;
};

Result<Board> CheckBoard(const Options& options) {
  Board board = options.board;
  if (board.first + board.Count() > tracker::kGolayNumbers) {
    return InputError("--first",
                      fmt::format("{} markers from number {} on go beyond the last number, {}",
                                  board.Count(), board.first, tracker::kGolayNumbers - 1),
                      "start lower or print fewer");
  }
  board.gap_mm = options.gap_mm.value_or(SmallestGap_mm(board.size_mm) * 2.0);
  if (!(board.gap_mm >= SmallestGap_mm(board.size_mm)) || board.gap_mm > kLargestMarker_mm) {
    return InputError("--gap-mm",
                      fmt::format("a gap of {:g} mm leaves markers of {:g} mm without their white "
                                  "margin",
                                  board.gap_mm, board.size_mm),
                      fmt::format("give {:g} mm or more", SmallestGap_mm(board.size_mm)));
  }
  return board;
}

/// Where the description goes. Beside the sheet only where nothing else has that name.
Result<fs::path> NameDescription(const Options& options) {
  if (!options.description.empty()) return fs::path(options.description);
  fs::path beside = fs::path(options.output).replace_extension(".json");
  std::error_code ignored;
  if (fs::exists(beside, ignored) && !IsBoardDescription(beside)) {
    return InputError(beside.string(), "is there and is no description of a board",
                      "name another file with --description");
  }
  return beside;
}

Result<void> Run(const Options& options) {
  if (options.output.empty()) {
    return InputError("--output", "the name is empty", "name a file, for example board.pdf");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const Board board, CheckBoard(options));
  PLEINAIR_ASSIGN_OR_RETURN(const PageSize page, ParsePageSize(options.page));
  PLEINAIR_ASSIGN_OR_RETURN(const SheetFormat format,
                            ChooseFormat(options.formats, options.output));
  PLEINAIR_ASSIGN_OR_RETURN(const Sheet sheet, BoardSheet(board, page));
  PLEINAIR_ASSIGN_OR_RETURN(const std::string content, RenderSheet(sheet, format));
  PLEINAIR_ASSIGN_OR_RETURN(const fs::path description, NameDescription(options));
  if (description == fs::path(options.output)) {
    return InputError("--description", "names the same file as --output", "give it another name");
  }
  PLEINAIR_RETURN_IF_ERROR(WriteSheetFile(description, DescribeBoard(board)));
  PLEINAIR_RETURN_IF_ERROR(WriteSheetFile(options.output, content));
  if (options.json) {
    std::cout << nlohmann::json{{"file", options.output},
                                {"description", description.string()},
                                {"page_mm", {page.width_mm, page.height_mm}},
                                {"first", board.first},
                                {"count", board.Count()}}
                     .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  }
  return {};
}

}  // namespace

void AddBoardCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("board", "Make a board of markers to print");
  command->footer(kExamples);
  const auto side = CLI::Range(1, tracker::kGolayNumbers);
  command->add_option("--columns", options->board.columns, "Markers side by side")
      ->check(side)
      ->capture_default_str();
  command->add_option("--rows", options->board.rows, "Markers one below the other")
      ->check(side)
      ->capture_default_str();
  command
      ->add_option("--first", options->board.first,
                   "Number of the top-left marker; the others follow row by row")
      ->check(CLI::Range(0, tracker::kGolayNumbers - 1))
      ->capture_default_str();
  command->add_option("--size-mm", options->board.size_mm, "Outer edge of each black square")
      ->type_name("MM")
      ->check(CLI::Range(kSmallestMarker_mm, kLargestMarker_mm))
      ->capture_default_str();
  command
      ->add_option("--gap-mm", options->gap_mm,
                   "Between the black squares; default 0.2, at least 0.1 of the size")
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
  command->callback([options, &result] { result.status = Run(*options); });
}

}  // namespace pleinair::app
