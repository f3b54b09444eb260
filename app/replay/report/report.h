#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/drape/scene_ink.h"
#include "app/output/light_csv.h"
#include "base/stage_times.h"
#include "compositor/antialiasing.h"
#include "devices/films/film_curve.h"
#include "scene/scene_description.h"
#include "session/anchors.h"
#include "session/lens_measurement.h"
#include "session/light_options.h"
#include "session/light_summary.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// A frame of the report before and after compositing; JPEG bytes.
struct ReportPicture {
  std::int64_t frame_index = 0;
  std::vector<std::uint8_t> before_jpeg;
  std::vector<std::uint8_t> after_jpeg;
};

/// How a replay was called.
struct ReplayCall {
  std::string version;
  std::string command;    ///< The whole command line.
  std::string recording;  ///< Path as given.
  std::string scene_file;
};

/// The composited frames.
struct ReplayedFilm {
  int width = 0, height = 0;  ///< Pixels.
  double frame_rate_hz = 0.0;
  devices::FilmCurve curve = devices::FilmCurve::kSrgb;  ///< Curve of the frames' pixel values.
  std::int64_t first_frame = 0;                          ///< Index in the recording.
  std::int64_t frames = 0;
  std::optional<std::int64_t> clock_start_ns;  ///< Its start by the camera's own clock.
  compositor::Antialiasing antialiasing;       ///< How the objects' edges are smoothed.
  std::optional<session::MeasuredLens> lens;   ///< By the marker; nothing: not looked for.
  std::optional<int> samples;  ///< That the renderer gives a pixel; nothing without objects.
};

/// The composited scene.
struct ReplayedScene {
  scene::PlaceTime place_time;
  scene::Cloudiness cloudiness = scene::Cloudiness::kClear;
  std::size_t virtual_objects = 0, phantoms = 0;
  std::vector<InkFacts> maps;  ///< As they were laid last.
};

/// What the camera's poses rest on, besides the marker.
struct ReplayedPlacing {
  session::AnchorSummary anchors;
  std::optional<session::TrajectorySummary> trajectory;  ///< Nothing: no trajectory was given.
};

/// The light of the frames.
struct ReplayedLight {
  session::LightChangeMode mode = session::LightChangeMode::kFollow;
  std::vector<LightRow> rows;  ///< One per frame; empty if nothing had to be lit.
};

/// The files that a replay wrote.
struct ReplayFiles {
  std::string time_lapse;            ///< HTML fragment that shows it; empty without.
  std::string video_encoder;         ///< Empty without video.
  std::vector<std::string> outputs;  ///< Relative to the output folder.
  std::vector<ReportPicture> pictures;
};

/// Results of a replay, for report.json and report.html.
struct ReplayReport {
  ReplayCall call;
  ReplayedFilm film;
  ReplayedScene scene;
  std::optional<session::MarkerName> reference_marker;
  std::vector<session::MarkerName> markers;  ///< Every observed marker.
  /// Camera trajectory against the reference marker: one entry per frame with a pose.
  std::vector<session::Observation> path;
  ReplayedPlacing placing;
  std::optional<session::LightSummary> light;  ///< Nothing if nothing had to be lit.
  ReplayedLight light_changes;
  ReplayFiles files;
  std::vector<std::string> warnings;
  std::vector<StageTimes::Summary> timings;  ///< The last is the total.
};

/// The last stage of a replay: the total, from reading the first frame to writing the report.
inline constexpr const char* kWholeReplay = "whole replay";

/// Frame rate that a stage would reach alone. Stages run in parallel.
inline double FramesPerSecond(const ReplayReport& report, const StageTimes::Summary& stage) {
  return stage.total_ms > 0.0 ? 1000.0 * static_cast<double>(report.film.frames) / stage.total_ms
                              : 0.0;
}

/// Statistics of the camera trajectory for the report.
struct PoseStatistics {
  double distance_min_m = 0.0, distance_median_m = 0.0, distance_max_m = 0.0;
  double path_length_m = 0.0;
  double step_rotation_p95_deg = 0.0;  ///< Between consecutive frames.
  double step_translation_p95_m = 0.0;
  double reprojection_median_px = 0.0, reprojection_p95_px = 0.0;
  std::int64_t ambiguous_frames = 0;               ///< Uncertain by their ambiguity ratio.
  double visible_min = 0.0, visible_median = 0.0;  ///< Visible fraction of the marker.
  std::array<std::int64_t, 3> found_by{};          ///< Frames per tracker::DetectionPath.
};

PoseStatistics SummarizeTrajectory(const std::vector<session::Observation>& path);

/// Frames after the first observation without an observation of the marker.
struct LostFrames {
  std::int64_t frames = 0;
  std::int64_t longest = 0;  ///< Consecutive frames.
};

/// Counts them in a trajectory. `end`: index of the frame after the film's last one.
LostFrames CountLostFrames(const std::vector<session::Observation>& path, std::int64_t end);

/// "clear", "hazy", "partly cloudy", "overcast".
const char* CloudinessName(scene::Cloudiness cloudiness);

}  // namespace pleinair::app
