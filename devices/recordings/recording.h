#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/camera_model.h"
#include "base/error.h"
#include "devices/frame_source.h"
#include "scene/scene_description.h"

namespace pleinair::devices {

struct RecordingOptions {
  /// Overrides the recording's own calibration; needed for a plain video.
  std::optional<std::filesystem::path> calibration;
  /// Overrides the recording's own scene. Place, time, marker and sky that it leaves out are taken
  /// from the recording, models never.
  std::optional<std::filesystem::path> scene;
};

/// An opened recording: its lens, its scene where it has one, and its frames in order.
struct Recording {
  std::filesystem::path path;
  CameraModel camera;
  std::optional<scene::SceneDescription> scene;
  double frame_rate_hz = 0.0;
  /// Bytes after the last whole frame of a live recording: it was cut there, by a power cut say.
  std::int64_t dropped_bytes = 0;
  std::unique_ptr<FrameSource> frames;
};

/// Opens a folder in the project's form (recording.json, scene.json or both;
/// docs/guide/reference/recordings.md), an EuRoC-style folder (mav0/cam0/data.csv and sensor.yaml,
/// at any of these levels), or a plain video file with `options.calibration`. Every frame must have
/// the calibration's size.
///
/// A folder's scene is its scene.toml, else its scene.json, else what recording.json says of
/// place, time and marker with phantom.obj and object.obj where they lie beside it. Ground truth
/// in these files is never looked at.
///
/// Errors, found before the first frame is asked for: what cannot be opened; JSON, TOML or YAML
/// that is cut short or senseless; pictures that are missing from the numbering or from what was
/// promised, cut short, or of another size than the calibration's; an MP4, MOV or AVI that is cut
/// short. Damage inside a video, and a cut in other containers, shows only when Next() gets there.
Result<Recording> OpenRecording(const std::filesystem::path& path,
                                const RecordingOptions& options = {});

}  // namespace pleinair::devices
