#include "scene/toml_trajectory.h"

#include <string>
#include <vector>

namespace pleinair::scene {
namespace {

/// A number within limits.
Result<std::optional<double>> NumberWithin(const TomlTable& table, const char* key, double low,
                                           double high, const char* remedy) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> number, table.Number(key));
  if (number && !(*number >= low && *number <= high)) {
    return table.Fail(key, "is out of range", remedy);
  }
  return number;
}

/// `scale`: a number, or "free".
Result<void> ReadScale(const TomlTable& table, TrajectoryDescription* trajectory) {
  const toml::node* node = table.Find("scale");
  if (node != nullptr && node->is_string()) {
    trajectory->is_scale_free = node->value_or(std::string()) == "free";
    if (trajectory->is_scale_free) return {};
    return table.Fail("scale", "is neither a number nor \"free\"",
                      "write the metres of one unit, or \"free\"");
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      trajectory->scale,
      NumberWithin(table, "scale", 1e-9, 1e9, "write the metres of one unit, or \"free\""));
  return {};
}

}  // namespace

Result<std::optional<TrajectoryDescription>> ReadTrajectoryTable(const TomlTable& scene) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables("trajectory"));
  if (tables.empty()) return std::nullopt;
  if (tables.size() > 1) {
    return scene.Fail("trajectory", "is given more than once", "keep one trajectory");
  }
  const TomlTable& table = tables[0];
  PLEINAIR_RETURN_IF_ERROR(table.AllowOnly({"file", "format", "points", "extrinsics", "offset_s",
                                            "scale", "turn_deg", "max_gap_s", "frame_rate_hz"}));
  TrajectoryDescription trajectory;
  const std::filesystem::path folder = std::filesystem::path(scene.file()).parent_path();
  const auto read_path = [&](const char* key, std::filesystem::path* path) -> Result<void> {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> text, table.Text(key));
    if (text) *path = (folder / *text).lexically_normal();
    return {};
  };
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> file, table.Text("file"));
  if (!file || file->empty()) {
    return scene.Fail("trajectory", "names no file", "add file = \"walk.tum\"");
  }
  PLEINAIR_RETURN_IF_ERROR(read_path("file", &trajectory.file));
  PLEINAIR_RETURN_IF_ERROR(read_path("points", &trajectory.points));
  PLEINAIR_RETURN_IF_ERROR(read_path("extrinsics", &trajectory.extrinsics));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> format, table.Text("format"));
  trajectory.format = format.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(
      trajectory.offset_s, NumberWithin(table, "offset_s", -9e9, 9e9, "write seconds, within 9e9"));
  PLEINAIR_RETURN_IF_ERROR(ReadScale(table, &trajectory));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<int> turn_deg, table.Integer("turn_deg"));
  trajectory.turn_deg = turn_deg.value_or(0);
  if (trajectory.turn_deg % 90 != 0 || trajectory.turn_deg < 0 || trajectory.turn_deg > 270) {
    return table.Fail("turn_deg", "is no quarter turn", "write 0, 90, 180 or 270");
  }
  PLEINAIR_ASSIGN_OR_RETURN(trajectory.max_gap_s, NumberWithin(table, "max_gap_s", 1e-3, 1e3,
                                                               "write 0.001 to 1000 seconds"));
  PLEINAIR_ASSIGN_OR_RETURN(
      trajectory.frame_rate_hz,
      NumberWithin(table, "frame_rate_hz", 1e-3, 1e6, "write 0.001 to 1e6 images a second"));
  return trajectory;
}

}  // namespace pleinair::scene
