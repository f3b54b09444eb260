#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/stage_times.h"
#include "scene/scene_description.h"
#include "session/light_summary.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// A frame shown in the report, before and after; JPEG bytes.
struct ReportPicture {
  std::int64_t frame_index = 0;
  std::vector<std::uint8_t> before_jpeg;
  std::vector<std::uint8_t> after_jpeg;
};

/// How a replay was called.
struct ReplayCall {
  std::string version;
  std::string command;    ///< As it was called.
  std::string recording;  ///< Path as given.
  std::string scene_file;
};

/// The composed frames.
struct ReplayedFilm {
  int width = 0, height = 0;  ///< Pixels.
  double frame_rate_hz = 0.0;
  std::int64_t frames = 0;
};

/// The scene that was composed.
struct ReplayedScene {
  scene::PlaceTime place_time;
  scene::Cloudiness cloudiness = scene::Cloudiness::kClear;
  std::size_t virtual_objects = 0, phantoms = 0;
};

/// What a replay wrote.
struct ReplayFiles {
  std::string time_lapse;            ///< Part of the page that shows it; empty without.
  std::string video_encoder;         ///< Empty without video.
  std::vector<std::string> outputs;  ///< Relative to the output folder.
  std::vector<ReportPicture> pictures;
};

/// What a replay did, for report.json and report.html.
struct ReplayReport {
  ReplayCall call;
  ReplayedFilm film;
  ReplayedScene scene;
  std::optional<session::MarkerName> reference_marker;
  std::vector<session::MarkerName> markers;  ///< Every marker seen.
  /// Of the reference marker, a frame it was seen in each.
  std::vector<session::Observation> path;
  std::optional<session::LightSummary> light;  ///< Nothing where nothing had to be lit.
  ReplayFiles files;
  std::vector<std::string> warnings;
  std::vector<StageTimes::Summary> timings;  ///< The last is the whole.
};

/// The last of a replay's stages: all of it, from the first frame's reading to the report.
inline constexpr const char* kWholeReplay = "whole replay";

/// Frames of the recording a second that a stage would do by itself. Stages run beside each other.
inline double FramesPerSecond(const ReplayReport& report, const StageTimes::Summary& stage) {
  return stage.total_ms > 0.0 ? 1000.0 * static_cast<double>(report.film.frames) / stage.total_ms
                              : 0.0;
}

/// Figures of the camera's path as the report states them.
struct PoseStatistics {
  double distance_min_m = 0.0, distance_median_m = 0.0, distance_max_m = 0.0;
  double path_length_m = 0.0;
  double step_rotation_p95_deg = 0.0;  ///< Between neighbouring frames.
  double step_translation_p95_m = 0.0;
  double reprojection_median_px = 0.0, reprojection_p95_px = 0.0;
  std::int64_t ambiguous_frames = 0;               ///< Not certain by their ambiguity ratio.
  double visible_min = 0.0, visible_median = 0.0;  ///< Share of the print that was seen.
  std::array<std::int64_t, 3> found_by{};          ///< Frames by tracker::DetectionPath.
};

PoseStatistics SummarizeTrajectory(const std::vector<session::Observation>& path);

/// Frames after the first observation in which the marker was not seen.
struct LostFrames {
  std::int64_t frames = 0;
  std::int64_t longest = 0;  ///< In a row.
};

/// Of a path through a recording of so many frames.
LostFrames CountLostFrames(const std::vector<session::Observation>& path, std::int64_t frames);

/// "clear", "hazy", "partly cloudy", "overcast".
const char* CloudinessName(scene::Cloudiness cloudiness);

}  // namespace pleinair::app
