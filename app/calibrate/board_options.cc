#include "app/calibrate/board_options.h"

#include <charconv>
#include <cmath>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/options/number_range.h"
#include "files/result_file.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::app {
namespace {

using tracker::BoardKind;
using tracker::CalibrationBoard;

/// Reads an integer of a description, within the range of boards; -1 if there is none.
int Whole(const nlohmann::json& json, const char* key) {
  const auto value = json.value(key, nlohmann::json());
  if (!value.is_number_integer()) return -1;
  const auto number = value.get<std::int64_t>();
  return number < 0 || number > 1'000'000 ? -1 : static_cast<int>(number);
}

double Length(const nlohmann::json& json, const char* key) {
  const auto value = json.value(key, nlohmann::json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

}  // namespace

void AddBoardOptions(CLI::App& command, BoardOptions& options) {
  command
      .add_option("--board", options.description,
                  "Board description that 'pleinair board' wrote beside its sheet")
      ->type_name("BOARD.json");
  command
      .add_option("--chessboard", options.chessboard,
                  "A chessboard: its inner corners, as OpenCV counts them")
      ->type_name("9x6");
  command
      .add_option("--charuco", options.charuco,
                  "A ChArUco board: its squares, as OpenCV counts them. The layout used before "
                  "OpenCV 4.6 is detected too")
      ->type_name("8x6");
  command
      .add_option("--dictionary", options.dictionary,
                  "Dictionary of the ChArUco board, such as 5x5_100; default: detected")
      ->type_name("NAME");
  command
      .add_option("--square-mm", options.square_mm,
                  "Side of a square. The lens does not depend on it")
      ->check(NumberRange(0.1, 10'000.0))
      ->type_name("MM");
}

Result<std::pair<int, int>> ParseSides(const std::string& option, const std::string& text) {
  std::pair<int, int> sides;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, sides.first);
  bool good =
      first.ec == std::errc() && first.ptr != end && (*first.ptr == 'x' || *first.ptr == 'X');
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, sides.second);
    good = second.ec == std::errc() && second.ptr == end && sides.first > 0 && sides.second > 0;
  }
  if (good) return sides;
  return InputError(option, "\"" + text.substr(0, 64) + "\" is not COLUMNSxROWS",
                    "write for example 9x6");
}

Result<CalibrationBoard> ReadBoardDescription(const std::string& file) {
  auto text = files::ReadTextFile(file);
  if (!text) {
    text.error().remedy = "check the name";
    return tl::make_unexpected(std::move(text).error());
  }
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  const auto fail = [&](const std::string& what) {
    return InputError(file, what, "name the .json that 'pleinair board' wrote beside the sheet");
  };
  if (!json.is_object()) return fail("is no description of a board");
  const auto family = json.value("family", nlohmann::json());
  CalibrationBoard board;
  if (family == "sg") {
    if (Whole(json, "version") != tracker::sg::kVersion) return fail("is of another version");
    board.kind = BoardKind::kMarkers;
    board.square_m = Length(json, "marker_size_m");
    board.gap_m = Length(json, "gap_m");
    const auto markers = json.value("markers", nlohmann::json());
    if (!markers.is_array() || markers.empty() || !markers[0].is_object()) {
      return fail("lists no markers");
    }
    board.first = Whole(markers[0], "id");
  } else if (family == "charuco" || family == "chessboard") {
    board.kind = family == "charuco" ? BoardKind::kCharuco : BoardKind::kChessboard;
    board.square_m = Length(json, "square_m");
    if (json.value("dictionary", nlohmann::json()).is_string()) {
      board.dictionary = json["dictionary"].get<std::string>();
    }
  } else {
    return fail("is no description of a board");
  }
  board.columns = Whole(json, "columns");
  board.rows = Whole(json, "rows");
  auto checked = tracker::CheckBoard(board);
  if (!checked) return fail(checked.error().what);
  return board;
}

Result<CalibrationBoard> BoardOf(const BoardOptions& options) {
  const int given = (options.description.empty() ? 0 : 1) + (options.chessboard.empty() ? 0 : 1) +
                    (options.charuco.empty() ? 0 : 1);
  if (given != 1) {
    return InputError(
        "", given == 0 ? "the board in the images is not given" : "more than one board is named",
        "give one of --board BOARD.json, --chessboard 9x6, --charuco 8x6, or --marker sg");
  }
  if (!options.dictionary.empty() && options.charuco.empty()) {
    return InputError("--dictionary", "is for --charuco alone", "leave it out");
  }
  if (!options.description.empty()) {
    if (options.square_mm) {
      return InputError("--square-mm", "is already in the board description", "leave it out");
    }
    return ReadBoardDescription(options.description);
  }
  CalibrationBoard board;
  const bool charuco = !options.charuco.empty();
  board.kind = charuco ? BoardKind::kCharuco : BoardKind::kChessboard;
  PLEINAIR_ASSIGN_OR_RETURN(const auto sides, charuco
                                                  ? ParseSides("--charuco", options.charuco)
                                                  : ParseSides("--chessboard", options.chessboard));
  board.columns = sides.first;
  board.rows = sides.second;
  board.dictionary = options.dictionary;
  board.square_m = options.square_mm.value_or(30.0) * 1e-3;
  PLEINAIR_RETURN_IF_ERROR(tracker::CheckBoard(board));
  return board;
}

}  // namespace pleinair::app
