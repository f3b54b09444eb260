#include "app/project/scene_text.h"

#include <fmt/format.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <system_error>

#include "devices/calibration/calibration_text.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

bool IsUtf8(const std::string& text) {
  // The strict printer throws at the first byte that is none.
  try {
    static_cast<void>(nlohmann::json(text).dump());
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
  return true;
}

/// Path of a file relative to a folder that may not exist yet.
Result<std::string> RelativeName(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path at = fs::absolute(file, error);
  const fs::path near = fs::proximate(at, fs::absolute(folder, error), error);
  std::string name = (error ? at : near).generic_string();
  if (IsUtf8(name)) return name;
  return InputError(file.string(), "has a name that is not UTF-8", "rename it");
}

/// A basic string of TOML 1.0; quotes, backslashes and control characters are escaped as in JSON.
std::string TomlString(const std::string& utf8) { return nlohmann::json(utf8).dump(); }

/// Comments are one line, whatever a file is called.
std::string Comment(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return IsUtf8(text) ? text : "a file whose name is not UTF-8";
}

std::string Line(const std::string& assignment, const std::string& from) {
  return fmt::format("{:<33} # {}\n", assignment, Comment(from));
}

bool IsObj(const fs::path& model) {
  std::string ending = model.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".obj";
}

std::string MarkerText(const NewScene& scene) {
  const ChosenMarker& marker = scene.marker;
  std::string text = "\n";
  text += Line("[marker]",
               fmt::format("up to {:.0f} pixels large in {}", marker.best_edge_px, scene.film));
  for (const session::MarkerName& other : marker.others) {
    text += Comment("# Also in view: " + other.ToString()) + "\n";
  }
  const std::string named =
      marker.is_stated ? "as you stated"
                       : fmt::format("seen in {} of {} {} of {}", marker.frames, marker.looked_at,
                                     marker.looked_at == 1 ? "frame" : "frames", scene.film);
  text += Line(fmt::format("family = \"{}\"", marker.name.family), named);
  text += Line(fmt::format("id = {}", marker.name.id), named);
  text += Line(fmt::format("size_mm = {:g}", scene.size_mm),
               "outer edge of the black square, as you stated");
  text += Line(fmt::format("upright = {}", scene.upright.value),
               scene.upright.from + "; true: it hangs on a wall");
  const StatedHeading& heading = scene.heading.value;
  text +=
      Line(fmt::format("{} = {:.7g}", heading.is_magnetic ? "heading_magnetic_deg" : "heading_deg",
                       heading.deg),
           scene.heading.from);
  text += scene.upright.value
              ? "# The heading is the direction in which you look when you read it, "
              : "# The heading is the direction of the top edge, ";
  return text + (heading.is_magnetic ? "as a compass shows it.\n" : "clockwise from true north.\n");
}

std::string GroundText(const NewScene& scene) {
  if (scene.upright.value && !scene.marker_height_m) {
    return "\n# No ground: write the height of the marker's centre above it, in metres.\n"
           "# [ground]\n# height_m = 1.5\n";
  }
  std::string text = "\n";
  text += Line("[ground]", "assumed: level");
  if (scene.marker_height_m) {
    text += Line(fmt::format("height_m = {:g}", *scene.marker_height_m),
                 "of the marker's centre above it, as you stated");
  }
  return text;
}

}  // namespace

Result<std::string> NewSceneToml(const NewScene& scene, const fs::path& folder) {
  std::string text =
      "# A scene for pleinair (docs/guide/reference/scenes.md lists every key).\n"
      "# Check what comes from tags, and what is assumed. A wrong hour or heading puts the shadow\n"
      "# where the real ones are not.\n";
  text += Comment("# The lens (in recording.json): " + scene.lens_from) + "\n\n";
  for (const std::string& note : scene.notes) text += Comment("# " + note) + "\n";
  text += Line("time = \"" + scene.time.value + "\"", "of the first frame; " + scene.time.from);
  text += Line("cloudiness = " + TomlString(scene.sky.value), scene.sky.from);
  const devices::FilmTags::Place& place = scene.place.value;
  text += "\n[place]\n";
  text += Line(fmt::format("latitude_deg = {:.6f}", place.latitude_deg), scene.place.from);
  text += Line(fmt::format("longitude_deg = {:.6f}", place.longitude_deg), scene.place.from);
  text += place.height_m ? Line(fmt::format("height_m = {:.0f}", *place.height_m),
                                "above sea level; " + scene.place.from)
                         : Line("# height_m = 0", "above sea level; nobody stated it");
  text += MarkerText(scene);
  text += GroundText(scene);
  text +=
      "\n# What else is really there hides objects and takes their shadow. Measure from the "
      "marker,\n"
      "# in metres: x to the right as you read it, y up, z out of it.\n"
      "# [[box]]\n# from_m = [1.2, 0.5, 0]\n# to_m = [1.8, 2.5, 0.45]\n"
      "# [[wall]]\n# corners_m = [[-3, 4, 0], [3, 4, 0], [3, 4, 2.5], [-3, 4, 2.5]]\n";
  if (!scene.model) {
    return text +
           "\n# The virtual object.\n# [[object]]\n# file = \"chair.glb\"\n"
           "# origin = \"bottom centre\"\n# translation_m = [0, 0, 0]\n";
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::string model, RelativeName(*scene.model, folder));
  text += "\n[[object]]                        # the virtual object\n";
  text += "file = " + TomlString(model) + "\n";
  text += Line("origin = \"bottom centre\"", "its lowest point stands at translation_m");
  text += Line("translation_m = [0, 0, 0]", "from the marker: right, up and out of it, metres");
  text += Line("rotation_deg = [0, 0, 0]", "the last one turns it on the ground");
  if (IsObj(*scene.model)) {
    // An OBJ states neither, and many programs write y up.
    text += Line("# up = \"y\"", "remove the first # if it lies on its side or its back");
  }
  text += Line("# unit = \"mm\"", "remove the first # if it is huge: mm, cm, m, in or ft");
  return text;
}

Result<std::string> NewTrajectoryToml(const scene::TrajectoryDescription& trajectory,
                                      const fs::path& folder) {
  std::string text = "\n";
  text += Line("[trajectory]", "of the camera; 'pleinair check' tells whether it fits the film");
  const auto add_file = [&](const char* key, const fs::path& file) -> Result<void> {
    if (file.empty()) return {};
    PLEINAIR_ASSIGN_OR_RETURN(const std::string name, RelativeName(file, folder));
    text += fmt::format("{} = {}\n", key, TomlString(name));
    return {};
  };
  const auto add_number = [&](const char* key, const std::optional<double>& number) {
    if (number) text += fmt::format("{} = {}\n", key, *number);
  };
  PLEINAIR_RETURN_IF_ERROR(add_file("file", trajectory.file));
  PLEINAIR_RETURN_IF_ERROR(add_file("points", trajectory.points));
  PLEINAIR_RETURN_IF_ERROR(add_file("extrinsics", trajectory.extrinsics));
  if (!trajectory.format.empty()) text += "format = " + TomlString(trajectory.format) + "\n";
  add_number("offset_s", trajectory.offset_s);
  add_number("scale", trajectory.scale);
  if (trajectory.is_scale_free) text += "scale = \"free\"\n";
  if (trajectory.turn_deg != 0) text += fmt::format("turn_deg = {}\n", trajectory.turn_deg);
  add_number("max_gap_s", trajectory.max_gap_s);
  add_number("frame_rate_hz", trajectory.frame_rate_hz);
  return text;
}

Result<std::string> NewRecordingJson(const fs::path& film, const KnownLens& lens,
                                     const fs::path& folder) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string name, RelativeName(film, folder));
  PLEINAIR_ASSIGN_OR_RETURN(const std::string calibration,
                            devices::CalibrationText(lens.camera, devices::CalibrationForm::kOwn));
  const nlohmann::ordered_json json{{"format", 1},
                                    {"program", kNewProgram},
                                    {"frames", name},
                                    {"calibration", nlohmann::ordered_json::parse(calibration)},
                                    {"calibration_from", Comment(lens.from)}};
  return json.dump(2) + "\n";
}

}  // namespace pleinair::app
