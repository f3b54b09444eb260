#include "export/print_sheets/board_description.h"

#include <cmath>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::exports {

double RoundedMetres(double mm) { return std::round(mm * 1e9) / 1e12; }

double MinGap_mm(double size_mm) { return size_mm * tracker::sg::kQuiet / tracker::sg::kEdge; }

std::string DescribeBoard(const Board& board) {
  nlohmann::ordered_json description = {{"format", 1},
                                        {"family", "sg"},
                                        {"version", tracker::sg::kVersion},
                                        {"columns", board.columns},
                                        {"rows", board.rows},
                                        {"marker_size_m", RoundedMetres(board.size_mm)},
                                        {"gap_m", RoundedMetres(board.gap_mm)}};
  for (int i = 0; i < board.Count(); ++i) {
    const Vec2 centre = board.Centre_mm(i);
    const double half = 0.5 * board.size_mm;
    nlohmann::ordered_json marker = {{"id", board.first + i}};
    for (const Vec2 towards : {Vec2{-1, 1}, Vec2{1, 1}, Vec2{1, -1}, Vec2{-1, -1}}) {
      const Vec2 corner = centre + towards * half;
      marker["corners_m"].push_back({RoundedMetres(corner.x), RoundedMetres(corner.y), 0.0});
    }
    description["markers"].push_back(std::move(marker));
  }
  return description.dump(1) + '\n';
}

bool IsBoardDescription(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("columns")) return false;
  const auto family = json.value("family", nlohmann::json());
  return (family == "sg" && json.contains("markers") && json.contains("marker_size_m")) ||
         ((family == "charuco" || family == "chessboard") && json.contains("square_m"));
}

}  // namespace pleinair::exports
