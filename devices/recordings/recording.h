#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "devices/films/film_curve.h"
#include "devices/frame_source.h"
#include "scene/scene_description.h"

namespace pleinair::devices {

struct RecordingOptions {
  /// Overrides the recording's own calibration; needed for a plain video.
  std::optional<std::filesystem::path> calibration;
  /// Overrides the recording's own scene. Missing place, time, marker and sky are taken from the
  /// recording; models never are.
  std::optional<std::filesystem::path> scene;
};

/// The file whose sound belongs to a recording.
struct RecordedSound {
  std::filesystem::path film;
  double start_s = 0.0;  ///< The container's time of the recording's stamp zero.
};

/// An open recording: calibration, scene (if it has one), and frames in order.
struct Recording {
  std::filesystem::path path;
  CameraModel camera;
  std::string camera_note;  ///< How the calibration was fitted to the film; empty: it was not.
  std::optional<scene::SceneDescription> scene;
  double frame_rate_hz = 0.0;
  bool is_photo = false;               ///< A single photograph.
  FilmCurve curve = FilmCurve::kSrgb;  ///< Of the frames, by a film's tags.
  std::optional<RecordedSound> sound;  ///< Of films that keep their own time stamps.
  /// Which frames are lost, as sentences. It grows while frames are read, and is complete after the
  /// last one. It must not be read while another thread reads frames.
  std::shared_ptr<const std::vector<std::string>> damage =
      std::make_shared<const std::vector<std::string>>();
  std::unique_ptr<FrameSource> frames;
};

/// Opens one of three kinds of recordings:
/// - A folder in the project's format has recording.json, scene.json or both
///   (docs/guide/reference/recordings.md).
/// - An EuRoC-style folder has mav0/cam0/data.csv and sensor.yaml. `path` may be any of these
///   levels.
/// - A plain video file comes with `options.calibration`.
///
/// Every frame must have the calibration's size. For a plain video, the calibration is scaled and
/// turned where possible (FitCamera()).
///
/// The scene of a folder is its scene.toml, else its scene.json. Without both, it is the place,
/// time and marker in recording.json, with phantom.obj and object.obj in the same folder. Ground
/// truth in these files is never read.
///
/// Errors, found before the first frame is decoded:
/// - Files cannot be opened.
/// - JSON, TOML or YAML is truncated or invalid.
/// - Images are missing from the sequence, are truncated, or have another size than the
///   calibration's.
/// - An MP4, MOV or AVI file is truncated.
///
/// A live recording's frames are those of its pack that are whole; `damage` states what is lost.
/// Next() reports damage inside a video, and truncation of other containers.
Result<Recording> OpenRecording(const std::filesystem::path& path,
                                const RecordingOptions& options = {});

}  // namespace pleinair::devices
