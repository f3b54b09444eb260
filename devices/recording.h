#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "base/camera_model.h"
#include "base/error.h"
#include "devices/frame_source.h"
#include "devices/scene_description.h"

namespace pleinair::devices {

struct RecordingOptions {
  std::optional<std::filesystem::path> calibration;  ///< Needed for a plain video.
  std::optional<std::filesystem::path> scene;        ///< Overrides the recording's own scene.
};

/// An opened recording: its lens, its scene where it has one, and its frames in order.
struct Recording {
  std::filesystem::path path;
  CameraModel camera;
  std::optional<SceneDescription> scene;
  double frame_rate_hz = 0.0;
  std::unique_ptr<FrameSource> frames;
};

/// Opens a folder in the project's form (recording.json/scene.json), an EuRoC-style folder
/// (mav0/cam0/data.csv, sensor.yaml), or a plain video file with `options.calibration`.
/// Every frame must have the calibration's size.
Result<Recording> OpenRecording(const std::filesystem::path& path,
                                const RecordingOptions& options = {});

}  // namespace pleinair::devices
