#include "app/options/trajectory_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/options/number_range.h"
#include "files/csv.h"

namespace pleinair::app {

void AddTrajectoryOptions(CLI::App& command, scene::TrajectoryDescription& trajectory) {
  CLI::Option* file = command.add_option(
      "--trajectory", trajectory.file,
      "Camera trajectory to compose along, also where no marker is seen: TUM (.tum, .txt), EuRoC "
      "(.csv), a COLMAP model (folder), Stray Scanner (its folder, or odometry.csv) or Record3D "
      "(its .r3d); replay takes it instead of the scene's [trajectory]");
  command
      .add_option("--trajectory-format", trajectory.format,
                  "Format of the trajectory where its name does not show it")
      ->check(CLI::IsMember({"tum", "euroc", "colmap", "stray", "record3d"}))
      ->needs(file);
  command
      .add_option("--trajectory-points", trajectory.points,
                  "Align the trajectory by three or more places instead of the marker: a text file "
                  "of lines X Y Z x y z, in the trajectory's frame of reference and in the "
                  "marker's (metres)")
      ->needs(file);
  command
      .add_option_function<double>(
          "--trajectory-offset-s", [&trajectory](double offset) { trajectory.offset_s = offset; },
          "Time of the recording minus time of the trajectory; default: estimated from the frames "
          "that show the marker")
      ->check(NumberRange(-9e9, 9e9))
      ->needs(file);
  command
      .add_option_function<std::string>(
          "--trajectory-scale",
          [&trajectory](const std::string& text) {
            trajectory.is_scale_free = text == "free";
            if (!trajectory.is_scale_free) trajectory.scale = files::ParseNumber(text);
          },
          "Metres of one unit of the trajectory, or the word free: not known, estimated from the "
          "marker; default: free for COLMAP, else 1")
      ->check(CLI::IsMember({"free"}) | NumberRange(1e-9, 1e9))
      ->type_name("NUMBER|free")
      ->needs(file);
  command
      .add_option("--trajectory-turn-deg", trajectory.turn_deg,
                  "Angle by which the frames are turned clockwise against the trajectory's images")
      ->check(CLI::IsMember({0, 90, 180, 270}))
      ->needs(file);
  command
      .add_option_function<double>(
          "--trajectory-max-gap-s", [&trajectory](double gap) { trajectory.max_gap_s = gap; },
          "Longest time between two poses of the trajectory across which poses are interpolated; "
          "default: 0.2")
      ->check(NumberRange(1e-3, 1e3))
      ->needs(file);
  command
      .add_option_function<double>(
          "--trajectory-frame-rate",
          [&trajectory](double rate) { trajectory.frame_rate_hz = rate; },
          "Images a second of a COLMAP model that has not every frame; default: the number that "
          "ends an image's name is that of its frame")
      ->check(NumberRange(1e-3, 1e6))
      ->needs(file);
  command
      .add_option("--trajectory-extrinsics", trajectory.extrinsics,
                  "sensor.yaml of a EuRoC camera: its pose on the body whose trajectory it is")
      ->needs(file);
}

std::string TrajectoryOptionText(const scene::TrajectoryDescription& trajectory,
                                 std::string (*quoted)(const std::string&)) {
  std::string text;
  const auto add_path = [&](const char* option, const std::filesystem::path& path) {
    if (!path.empty()) text += fmt::format(" {} {}", option, quoted(path.string()));
  };
  const auto add_number = [&](const char* option, const std::optional<double>& number) {
    if (number) text += fmt::format(" {} {}", option, *number);
  };
  add_path("--trajectory", trajectory.file);
  if (!trajectory.format.empty()) text += " --trajectory-format " + trajectory.format;
  add_path("--trajectory-points", trajectory.points);
  add_number("--trajectory-offset-s", trajectory.offset_s);
  add_number("--trajectory-scale", trajectory.scale);
  if (trajectory.is_scale_free) text += " --trajectory-scale free";
  if (trajectory.turn_deg != 0) {
    text += fmt::format(" --trajectory-turn-deg {}", trajectory.turn_deg);
  }
  add_number("--trajectory-max-gap-s", trajectory.max_gap_s);
  add_number("--trajectory-frame-rate", trajectory.frame_rate_hz);
  add_path("--trajectory-extrinsics", trajectory.extrinsics);
  return text;
}

}  // namespace pleinair::app
