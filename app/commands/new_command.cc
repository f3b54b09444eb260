#include <unistd.h>

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/model_options.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"
#include "app/options/place_option.h"
#include "app/options/trajectory_options.h"
#include "app/project/new_project.h"
#include "app/project/questions.h"
#include "files/csv.h"

namespace pleinair::app {
namespace {

constexpr const char* kNewExamples =
    "Examples:\n"
    "  pleinair new walk.mov --model chair.glb -o site\n"
    "      looks at the film, asks for what it does not show, composes site/first.png\n"
    "  pleinair new walk.mov still.jpg --model chair.glb -o site\n"
    "      the heading by the compass of a photograph that shows the marker\n"
    "  pleinair new walk.mov --model chair.glb -o site --yes --size-mm 200 --heading 342\n"
    "      asks nothing: time and place are those of the film's tags\n"
    "  pleinair new walk.mp4 -o site --size-mm 200 --heading-magnetic 337 \\\n"
    "      --time '2025-09-14T13:05:00[Europe/Prague]' --at 50.0875,14.4213,220\n"
    "  pleinair new scan/rgb.mp4 --trajectory scan -o site\n"
    "      a walk of Stray Scanner: the scene names its trajectory, whose lens counts\n"
    "  pleinair check site && pleinair replay site -o out\n"
    "The folder gets scene.toml with a comment beside every value, recording.json with the lens "
    "and\n"
    "the film's name, and first.png. The film stays where it is. docs/guide/phone.md leads "
    "through.";

/// Parsed command line.
struct NewArguments {
  std::vector<std::string> files;
  std::string output;
  struct Words {
    std::string model, calibration, marker, time, place, sky;
  } words;  ///< Empty: not given.
  std::optional<double> heading_deg, heading_magnetic_deg;
  std::optional<double> size_mm, marker_height_m;
  bool upright = false;
  scene::TrajectoryDescription trajectory;
  struct Flags {
    bool yes = false, force = false, json = false;
  } flags;
};

Result<session::MarkerName> ParseMarkerName(const std::string& text) {
  const std::size_t bar = text.rfind('_');
  const auto number =
      bar == std::string::npos ? std::nullopt : files::ParseNumber(text.substr(bar + 1));
  constexpr double kMostNumbers = 1e6;
  if (number && bar > 0 && *number >= 0 && *number <= kMostNumbers &&
      *number == static_cast<int>(*number)) {
    return session::MarkerName{text.substr(0, bar), static_cast<int>(*number)};
  }
  return InputError("--marker", "\"" + text.substr(0, 40) + "\" is no marker",
                    "write its family and number, sg_17 or tag36h11_0");
}

Result<NewProjectRequest> RequestOf(const NewArguments& arguments) {
  NewProjectRequest request;
  request.files.assign(arguments.files.begin(), arguments.files.end());
  request.folder = arguments.output;
  if (!arguments.words.calibration.empty()) request.calibration = arguments.words.calibration;
  if (!arguments.words.marker.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(request.marker, ParseMarkerName(arguments.words.marker));
  }
  StatedScene& stated = request.stated;
  if (!arguments.words.time.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(stated.time, ParseSceneTime(arguments.words.time));
  }
  if (!arguments.words.place.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(stated.place, ParsePlace(arguments.words.place));
  }
  if (arguments.heading_deg) stated.heading = StatedHeading{*arguments.heading_deg, false};
  if (arguments.heading_magnetic_deg) {
    stated.heading = StatedHeading{*arguments.heading_magnetic_deg, true};
  }
  if (!arguments.words.sky.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(stated.sky, ParseSky(arguments.words.sky));
  }
  stated.size_mm = arguments.size_mm;
  stated.marker_height_m = arguments.marker_height_m;
  stated.upright = arguments.upright;
  if (!arguments.words.model.empty()) stated.model = arguments.words.model;
  stated.accepts_tags = arguments.flags.yes;
  if (!arguments.trajectory.file.empty()) request.trajectory = arguments.trajectory;
  request.replaces = arguments.flags.force;
  return request;
}

std::string NewProjectJson(const NewProject& project, const std::string& folder) {
  const NewScene& scene = project.scene;
  const nlohmann::ordered_json json{{"project", folder},
                                    {"marker", scene.marker.name.ToString()},
                                    {"marker_edge_px", scene.marker.best_edge_px},
                                    {"first_picture_frame", project.first_picture_frame},
                                    {"time", scene.time.value},
                                    {"time_from", scene.time.from},
                                    {"latitude_deg", scene.place.value.latitude_deg},
                                    {"longitude_deg", scene.place.value.longitude_deg},
                                    {"place_from", scene.place.from},
                                    {"heading_deg", scene.heading.value.deg},
                                    {"heading_is_magnetic", scene.heading.value.is_magnetic},
                                    {"heading_from", scene.heading.from},
                                    {"size_mm", scene.size_mm},
                                    {"sky", scene.sky.value},
                                    {"sky_from", scene.sky.from},
                                    {"lens_from", scene.lens_from},
                                    {"warnings", project.warnings}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Result<void> RunNew(const NewArguments& arguments) {
  PLEINAIR_ASSIGN_OR_RETURN(const NewProjectRequest request, RequestOf(arguments));
  Questions terminal(std::cin, std::cerr);
  const bool may_ask =
      !arguments.flags.yes && isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
  PLEINAIR_ASSIGN_OR_RETURN(const NewProject project,
                            MakeProject(request, may_ask ? &terminal : nullptr));
  if (arguments.flags.json) {
    std::cout << NewProjectJson(project, arguments.output) << '\n';
    return {};
  }
  const ChosenMarker& marker = project.scene.marker;
  std::cout << fmt::format("marker {}, {:.0f} pixels large in frame {}\n", marker.name.ToString(),
                           marker.best_edge_px, project.first_picture_frame)
            << fmt::format("size: {:g} mm (as you stated)\n", project.scene.size_mm)
            << fmt::format("heading: {:g} degrees from {} north ({})\n",
                           project.scene.heading.value.deg,
                           project.scene.heading.value.is_magnetic ? "magnetic" : "true",
                           project.scene.heading.from)
            << fmt::format("time: {} ({})\n", project.scene.time.value, project.scene.time.from)
            << fmt::format("place: {:.4f}, {:.4f} ({})\n", project.scene.place.value.latitude_deg,
                           project.scene.place.value.longitude_deg, project.scene.place.from)
            << fmt::format("sky: {} ({})\n", project.scene.sky.value, project.scene.sky.from)
            << fmt::format("lens: {}\n", project.scene.lens_from)
            << fmt::format(
                   "{0}: scene.toml recording.json first.png\n"
                   "Look at first.png, correct scene.toml, then: pleinair check {0}; "
                   "pleinair replay {0} -o OUT\n",
                   arguments.output);
  for (const std::string& warning : project.warnings) std::cerr << "warning: " << warning << '\n';
  return {};
}

}  // namespace

void AddNewCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      app.add_subcommand("new", "Make a project from a film: its scene, and a first picture");
  command->footer(kNewExamples);
  auto arguments = std::make_shared<NewArguments>();
  command
      ->add_option("FILM", arguments->files,
                   "A film; photographs (JPEG) beside it, for their time, place and direction. "
                   "Without a film the first photograph is composed")
      ->required();
  command->add_option("-o,--output", arguments->output, "Folder of the project")->required();
  command->add_option("--model", arguments->words.model,
                      "Virtual object, glTF or OBJ; it stands on the marker");
  command->add_option("--size-mm", arguments->size_mm, "Marker: outer edge of its black square, mm")
      ->check(NumberRange(0.1, 1e6));
  CLI::Option* heading =
      command
          ->add_option("--heading", arguments->heading_deg,
                       "Direction of the marker's top edge, degrees clockwise from true north; "
                       "with --upright the direction in which you look when you read it")
          ->type_name("DEG")
          ->check(NumberRange(-360.0, 360.0));
  command
      ->add_option("--heading-magnetic", arguments->heading_magnetic_deg,
                   "The same, as a compass shows it")
      ->type_name("DEG")
      ->check(NumberRange(-360.0, 360.0))
      ->excludes(heading);
  command->add_option("--time", arguments->words.time,
                      "Time of the first frame: 2025-09-14T13:05:00+02:00, …Z, or a local time and "
                      "its zone, 2025-09-14T13:05:00[Europe/Prague]");
  command
      ->add_option("--at", arguments->words.place,
                   "Place: degrees north and east and, if known, metres above sea level")
      ->type_name("LAT,LON[,HEIGHT]");
  command->add_flag("--upright", arguments->upright, "The marker hangs on a wall");
  command
      ->add_option("--marker-height", arguments->marker_height_m,
                   "The marker's centre above the ground, metres; default: it lies on the ground. "
                   "Without it, an upright marker has no ground")
      ->type_name("M")
      ->check(NumberRange(0.0, 1000.0));
  command->add_option("--sky", arguments->words.sky,
                      "Cloudiness: clear (default), hazy, partly cloudy, overcast");
  command->add_option("--calibration", arguments->words.calibration,
                      "Calibration of the film's lens; one of another size is scaled and turned. "
                      "Default: the film's own markers tell it, else "
                      "the focal length in its tags, else "
                      "26 mm on 35 mm film, as of a usual phone");
  command->add_option("--marker", arguments->words.marker,
                      "Marker to use, sg_17 or tag36h11_0. Default: the one most frames show");
  AddTrajectoryOptions(*command, arguments->trajectory);
  command->add_flag("-y,--yes", arguments->flags.yes,
                    "Ask nothing; take time, place and direction of the files' tags");
  command->add_flag("--force", arguments->flags.force, "Replace an earlier project in the folder");
  AddModelFileOptions(*command);
  command->add_flag("--json", arguments->flags.json, "Print a summary as one JSON object");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunNew(*arguments); });
}

}  // namespace pleinair::app
