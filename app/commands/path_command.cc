#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands/command.h"
#include "app/options/number_range.h"
#include "devices/calibration/calibration.h"
#include "export/trajectories/trajectory_files.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

constexpr const char* kPathExamples =
    "Examples:\n"
    "  pleinair path convert out/demo/poses/sg_17.tum path.glb --calibration camera.json\n"
    "  pleinair path convert out/demo/poses/sg_17.tum model/ --calibration camera.json\n"
    "  pleinair path convert mav0/state_groundtruth_estimate0/data.csv cam0.tum \\\n"
    "    --extrinsics mav0/cam0/sensor.yaml\n"
    "  pleinair path convert sparse/0 text/ --frame-rate 30\n"
    "  pleinair path convert sparse/0 walk.glb --frame-rate 30 --axes y-down --scale 0.42\n"
    "  pleinair path convert scan/ walk.tum   (Stray Scanner: odometry.csv; Record3D: walk.r3d)\n"
    "Read: TUM (.tum, .txt), EuRoC (.csv), COLMAP (a folder with cameras and images, .txt or "
    ".bin), Stray Scanner, Record3D.\n"
    "Written: TUM, EuRoC, COLMAP as text or, with --to colmap-binary, as .bin; glTF (.glb, .gltf) "
    "and MCAP (.mcap). docs/guide/trajectories.md explains each format.";

struct PathArguments {
  std::string input, output, from, to, calibration, extrinsics, axes = "z-up";
  double frame_rate_hz = 0.0, scale = 1.0, marker_size_mm = 0.0;
  bool json = false;
};

Result<exports::TrajectoryFormat> FormatToRead(const std::string& stated, const std::string& file) {
  if (const auto named = exports::TrajectoryFormatNamed(stated)) return *named;
  auto format = exports::TrajectoryFormatToRead(file);
  if (format && *format == exports::TrajectoryFormat::kRecord3d && file.ends_with("report.json")) {
    return InputError(file, "is a report of pleinair, not a trajectory",
                      "name one of the files in the folder poses beside it");
  }
  return format;
}

Result<exports::TrajectoryFormat> FormatToWrite(const std::string& stated,
                                                const std::string& file) {
  using exports::TrajectoryFormat;
  if (const auto named = exports::TrajectoryFormatNamed(stated)) return *named;
  constexpr const char* kRemedy =
      "name it .tum, .csv, .glb, .gltf or .mcap or a new folder (COLMAP), or state it with --to";
  const auto format = exports::TrajectoryFormatOf(file);
  if (!format) return InputError(file, "has a name without a format that can be written", kRemedy);
  if (*format == TrajectoryFormat::kRecord3d || *format == TrajectoryFormat::kStray) {
    return InputError(file, "is or names a trajectory of another app, which is only read", kRemedy);
  }
  return *format;
}

Result<void> RunPath(const PathArguments& arguments) {
  PLEINAIR_ASSIGN_OR_RETURN(const exports::TrajectoryFormat from,
                            FormatToRead(arguments.from, arguments.input));
  PLEINAIR_ASSIGN_OR_RETURN(const exports::TrajectoryFormat to,
                            FormatToWrite(arguments.to, arguments.output));
  exports::TrajectoryReading reading;
  reading.frame_rate_hz = arguments.frame_rate_hz;
  if (!arguments.extrinsics.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(
        const std::string yaml,
        files::ReadWholeFile(arguments.extrinsics, files::kMaxCalibrationBytes));
    PLEINAIR_ASSIGN_OR_RETURN(reading.body_from_camera,
                              devices::ParseEurocExtrinsics(yaml, arguments.extrinsics));
  }
  PLEINAIR_ASSIGN_OR_RETURN(exports::CameraTrajectory path,
                            exports::ReadTrajectory(arguments.input, from, reading));
  if (!arguments.calibration.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(path.camera, devices::ReadCalibration(arguments.calibration));
  }
  exports::ScaleTrajectory(arguments.scale, &path);
  exports::TrajectoryWriting writing;
  writing.up = arguments.axes == "z-up"   ? exports::UpAxis::kZ
               : arguments.axes == "y-up" ? exports::UpAxis::kY
                                          : exports::UpAxis::kMinusY;
  writing.marker_size_m = arguments.marker_size_mm * 1e-3;
  writing.body_from_camera = reading.body_from_camera;
  if (auto written = exports::WriteTrajectory(path, arguments.output, to, writing); !written) {
    Error failure = std::move(written).error();
    if (failure.where.empty()) failure.where = arguments.output;
    return tl::make_unexpected(std::move(failure));
  }
  const double seconds =
      1e-9 * static_cast<double>(path.poses.back().timestamp_ns - path.poses.front().timestamp_ns);
  if (arguments.json) {
    const nlohmann::ordered_json summary{{"file", arguments.output},
                                         {"poses", path.poses.size()},
                                         {"seconds", seconds},
                                         {"has_camera", path.camera.has_value()},
                                         {"points", path.points.size()}};
    std::cout << summary.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else {
    std::cerr << path.poses.size() << " poses over " << seconds << " s written to "
              << arguments.output << '\n';
  }
  return {};
}

}  // namespace

void AddPathCommand(CLI::App& app, CommandResult& result) {
  CLI::App* path = app.add_subcommand("path", "Convert camera trajectories for other programs");
  path->footer(kPathExamples);
  path->require_subcommand(1);
  CLI::App* command = path->add_subcommand(
      "convert", "Convert a camera trajectory to another format and its frame of reference");
  command->footer(kPathExamples);
  auto arguments = std::make_shared<PathArguments>();
  command->add_option("IN", arguments->input, "Trajectory to read")->required();
  command->add_option("OUT", arguments->output, "File or folder to write")->required();
  command->add_option("--from", arguments->from, "Format of IN where its name does not show it")
      ->check(CLI::IsMember({"tum", "euroc", "colmap", "stray", "record3d"}));
  command->add_option("--to", arguments->to, "Format of OUT where its name does not show it")
      ->check(CLI::IsMember({"tum", "euroc", "colmap", "colmap-binary", "gltf", "mcap"}));
  command->add_option("--calibration", arguments->calibration,
                      "Camera calibration for glTF, MCAP and COLMAP, instead of IN's own");
  command
      ->add_option("--frame-rate", arguments->frame_rate_hz,
                   "Pictures a second of a COLMAP model: a picture's time is the number that ends "
                   "its name, divided by this")
      ->check(NumberRange(1e-3, 1e6));
  command->add_option(
      "--extrinsics", arguments->extrinsics,
      "sensor.yaml of a EuRoC camera: its T_BS maps between the body, whose trajectory EuRoC files "
      "hold, and the camera; without it the camera is the body");
  command
      ->add_option("--axes", arguments->axes,
                   "Orientation of the trajectory's frame of reference, for glTF: z-up (a marker "
                   "on the ground), y-up (a marker on a wall) or y-down (many reconstructions)")
      ->check(CLI::IsMember({"z-up", "y-up", "y-down"}))
      ->capture_default_str();
  command
      ->add_option("--scale", arguments->scale,
                   "Metres of one unit of IN: reconstructions have no scale")
      ->check(NumberRange(1e-9, 1e9));
  command
      ->add_option("--marker-size-mm", arguments->marker_size_mm,
                   "Show the marker, this large, at the reference's origin (glTF, MCAP)")
      ->check(NumberRange(0.1, 1e6));
  command->add_flag("--json", arguments->json, "Print a summary as one JSON object");
  command->callback([arguments, &result] { result.status = RunPath(*arguments); });
}

}  // namespace pleinair::app
