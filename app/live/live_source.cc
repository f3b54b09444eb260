#include "app/live/live_source.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "app/live/paced_recording.h"
#include "app/options/local_time.h"
#include "app/replay/given_trajectory.h"
#include "devices/calibration/calibration.h"
#include "devices/recordings/recording.h"

namespace pleinair::app {
namespace {

std::vector<devices::ControlRequest> ControlsOf(const LiveHolds& holds) {
  std::vector<devices::ControlRequest> control_requests;
  const auto add = [&](devices::CameraControl control, const std::optional<double>& value) {
    if (value || holds.all) control_requests.push_back({control, value});
  };
  add(devices::CameraControl::kExposure, holds.exposure_s);
  add(devices::CameraControl::kGain, holds.gain);
  add(devices::CameraControl::kWhiteBalance, holds.white_balance_k);
  add(devices::CameraControl::kFocus, holds.focus);
  return control_requests;
}

Result<LiveSource> OpenFile(const devices::CameraUri& uri, const LiveArguments& arguments) {
  devices::RecordingOptions options;
  if (!arguments.input.calibration.empty()) options.calibration = arguments.input.calibration;
  if (!arguments.input.scene.empty()) options.scene = arguments.input.scene;
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording,
                            devices::OpenRecording(uri.value, options));
  if (arguments.lossless && (arguments.input.loop || !arguments.headless)) {
    return InputError("--lossless",
                      "processes the recording once, as fast as this machine can, without a window",
                      "add --headless and leave --loop out");
  }
  LiveSource source{std::move(recording.frames), nullptr, recording.camera, recording.scene,
                    devices::ResponseOf(recording.curve)};
  const auto open = [path = uri.value, options] { return devices::OpenRecording(path, options); };
  if (source.scene && source.scene->trajectory) {
    PLEINAIR_ASSIGN_OR_RETURN(auto request, ReadGivenTrajectory(*source.scene->trajectory));
    source.trajectory = std::make_shared<LiveTrajectory>(std::move(request), *source.scene, open);
  }
  if (arguments.lossless) return source;
  const auto reopen = [open]() -> Result<std::unique_ptr<devices::FrameSource>> {
    PLEINAIR_ASSIGN_OR_RETURN(devices::Recording again, open());
    return std::move(again.frames);
  };
  PacedRecording::Options pace{arguments.input.rate_hz, arguments.input.loop};
  if (source.trajectory) {
    pace.played = [trajectory = source.trajectory](std::int64_t index,
                                                   const devices::Frame& recorded) {
      trajectory->Played(index, {recorded.index, recorded.timestamp_ns});
    };
  }
  PLEINAIR_ASSIGN_OR_RETURN(source.frames, PacedRecording::Open(reopen, pace));
  return source;
}

Result<LiveSource> OpenCamera(const devices::CameraUri& uri, const LiveArguments& arguments) {
  if (arguments.lossless) {
    return InputError("--lossless", "is for recordings: a camera does not wait", "leave it out");
  }
  if (arguments.input.calibration.empty()) {
    return InputError("--calibration", "is missing: a camera does not report its lens",
                      "calibrate it once ('pleinair calibrate') and name the file");
  }
  LiveSource source;
  PLEINAIR_ASSIGN_OR_RETURN(source.lens, devices::ReadCalibration(arguments.input.calibration));
  if (!arguments.input.scene.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(source.scene, scene::ReadSceneDescription(arguments.input.scene));
    if (source.scene->trajectory) {
      return InputError(arguments.input.scene,
                        "has a [trajectory], which belongs to a recording, not to a camera",
                        "play the recording (--camera file:PATH), or take [trajectory] out");
    }
  }
  devices::LiveCameraOptions options;
  options.uri = uri;
  options.pictures.size = ImageSize{source.lens.width, source.lens.height};
  options.pictures.rate_hz = arguments.input.rate_hz;
  if (!arguments.input.pixel_format.empty()) {
    options.pictures.format = devices::PixelFormatByName(arguments.input.pixel_format);
    if (!options.pictures.format) {
      return InputError("--format", "\"" + arguments.input.pixel_format + "\" is not supported",
                        "'pleinair devices' lists what the camera sends");
    }
  }
  options.controls = ControlsOf(arguments.input.holds);
  PLEINAIR_ASSIGN_OR_RETURN(auto camera, devices::LiveCamera::Open(std::move(options)));
  source.camera = camera.get();
  source.frames = std::move(camera);
  return source;
}

}  // namespace

Result<LiveSource> OpenLiveSource(const devices::CameraUri& uri, const LiveArguments& arguments) {
  const bool is_file = uri.backend == devices::CameraUri::Backend::kFile;
  return is_file ? OpenFile(uri, arguments) : OpenCamera(uri, arguments);
}

Result<std::optional<UtcTime>> StartOf(const LiveArguments& arguments, const LiveSource& source) {
  if (arguments.input.time == "now") return std::nullopt;
  if (!arguments.input.time.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const UtcTime time, ParseTimeOption("--time", arguments.input.time));
    return time;
  }
  // A recording has its own start time; a camera uses the current time.
  if (source.camera != nullptr) return std::nullopt;
  return source.scene->place_time.start;
}

}  // namespace pleinair::app
