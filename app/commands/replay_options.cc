#include "app/commands/replay_options.h"

#include <CLI/CLI.hpp>

#include "app/options/antialiasing_options.h"
#include "app/options/defocus_options.h"
#include "app/options/light_options.h"
#include "app/options/model_options.h"
#include "app/options/motion_blur_options.h"
#include "app/options/number_range.h"
#include "app/options/trajectory_options.h"

namespace pleinair::app {

void AddReplayOptions(CLI::App& command, ReplayArguments& arguments) {
  command
      .add_option("RECORDING", arguments.paths.recordings,
                  "Folder of a project or recording (pleinair's own or EuRoC's), a film, or a "
                  "picture; several: each gets its own folder in the output folder")
      ->required();
  command.add_option("-o,--output", arguments.paths.output, "Folder for the results")->required();
  command.add_option("--shard", arguments.shard,
                     "Compose every N-th of several recordings, from the I-th: I/N");
  command.add_option("--scene", arguments.paths.scene,
                     "Scene file (TOML or JSON) instead of the recording's own");
  command.add_option("--calibration", arguments.paths.calibration,
                     "Calibration of the lens (own JSON, OpenCV, ROS or Kalibr YAML)");
  CLI::Option* frame =
      command
          .add_option("--frame", arguments.range.frame,
                      "Compose this frame alone, counted from 0, as a PNG picture in frames/")
          ->check(CLI::NonNegativeNumber);
  constexpr double kMaxTime_s = 1e8;
  command
      .add_option("--from", arguments.range.from_s,
                  "Begin with the first frame at or after this time, in seconds of the recording")
      ->check(NumberRange(0.0, kMaxTime_s))
      ->excludes(frame);
  command
      .add_option("--to", arguments.range.to_s,
                  "End with the last frame at or before this time, in seconds of the recording")
      ->check(NumberRange(0.0, kMaxTime_s))
      ->excludes(frame);
  AddTrajectoryOptions(command, arguments.options.trajectory);
  AddModelFileOptions(command);
  command.add_flag("--frames", arguments.written.frames, "Also write every frame as a PNG picture");
  command
      .add_option("--export", arguments.exports,
                  "Also write the camera's trajectory for other programs: gltf (camera.glb), "
                  "colmap or colmap-binary (colmap/), euroc (poses/MARKER.csv), mcap (camera.mcap)")
      ->delimiter(',')
      ->check(CLI::IsMember({"gltf", "colmap", "colmap-binary", "euroc", "mcap"}))
      ->type_name("FORM,...");
  command.add_option("--size", arguments.size, "Size of the output, WIDTHxHEIGHT in pixels");
  AddLightOptions(command, arguments.options.light);
  AddLightChangeOption(command, "the whole recording", arguments.options.light);
  command
      .add_option("--fog", arguments.drawing.fog,
                  "Haze in front of the virtual objects and their shadows, as a multiple of the "
                  "day's own; one number, or one a partition from near to far; 0: none. Default: 1")
      ->delimiter(',')
      ->expected(1, 4)
      ->check(NumberRange(0.0, 1e6))
      ->type_name("TIMES,...");
  AddAntialiasingOptions(command, arguments.drawing.antialiasing);
  AddDefocusOptions(command, arguments.drawing.defocus);
  AddMotionBlurOptions(command, arguments.drawing.motion_blur);
  CLI::Option* time_lapse = command.add_option(
      "--time-lapse", arguments.day.hours,
      "Also draw the whole scene, phantoms in their own colours, over time: timelapse.mp4 and the "
      "sheet timelapse.png; with --frames each picture. Hours of its day on a clock, 05:00..21:00 "
      "or 05:00..21:00+02:00, or the word day: while it is light. Or dates at a time of day, "
      "2025-04-15..2025-10-15@12:00, with the leaves of each date");
  time_lapse->type_name("HOURS|day|DATES");
  command
      .add_option("--every", arguments.day.every,
                  "Step of the time-lapse: 10min (default), 90s, 1h; of dates 1d (default), 7d, 2w")
      ->needs(time_lapse);
  command
      .add_option("--time-lapse-frame", arguments.day.frame,
                  "Frame from whose camera the time-lapse is seen; default: the middle one")
      ->needs(time_lapse)
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--no-video", arguments.written.no_video, "Do not write composite.mp4");
  command.add_flag("--resume", arguments.written.resume,
                   "Keep unfinished outputs in the folder 'unfinished' of the output folder. The "
                   "same command then goes on where a replay was ended");
  command.add_flag("--json", arguments.json, "Print a summary as one JSON object");
}

}  // namespace pleinair::app
