#include "app/accuracy/recording_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "accuracy/scoring.h"
#include "accuracy/seen_print.h"
#include "app/accuracy/own_detector.h"
#include "app/paths/path_files.h"
#include "app/scene_marker.h"
#include "devices/recording.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

Result<Trajectory> ReadTruth(const fs::path& recording) {
  const fs::path file = recording / "truth.tum";
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    return InputError(recording.string(), "has no ground truth",
                      "put truth.tum beside its frames: the camera in the marker's frame");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const CameraPath path, ReadPath(file, PathFormat::kTum, {}));
  return TrajectoryOf(path);
}

/// The true pose nearest in time, if within `reach_ns`.
const TimedPose* PoseAt(const Trajectory& truth, std::int64_t timestamp_ns, std::int64_t reach_ns) {
  const auto after = std::lower_bound(
      truth.begin(), truth.end(), timestamp_ns,
      [](const TimedPose& pose, std::int64_t time) { return pose.timestamp_ns < time; });
  const TimedPose* nearest = nullptr;
  const auto consider = [&](const TimedPose& pose) {
    const std::int64_t away = std::llabs(pose.timestamp_ns - timestamp_ns);
    if (away > reach_ns) return;
    if (nearest == nullptr || away < std::llabs(nearest->timestamp_ns - timestamp_ns)) {
      nearest = &pose;
    }
  };
  if (after != truth.end()) consider(*after);
  if (after != truth.begin()) consider(*(after - 1));
  return nearest;
}

/// The marker whose truth is known, as a detector of its family sees it.
struct Anchor {
  int number = 0;
  Metres size;
};

std::optional<accuracy::MarkerTruth> TruthOf(const CameraModel& camera, const Anchor& anchor,
                                             const TimedPose& pose) {
  accuracy::MarkerTruth truth{.number = anchor.number,
                              .camera_from_marker = pose.marker_from_camera.Inverse()};
  for (const Vec2 corner : {Vec2{-1, 1}, Vec2{1, 1}, Vec2{1, -1}, Vec2{-1, -1}}) {
    const Vec2 at = corner * (0.5 * anchor.size.value());
    if ((truth.camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}}).xyz.z <= 0.0) {
      return std::nullopt;
    }
  }
  truth.corners_px = accuracy::SquareCorners(camera, truth.camera_from_marker, anchor.size);
  return truth;
}

}  // namespace

Result<std::vector<accuracy::FrameRecord>> MeasureRecording(const std::string& path,
                                                            std::int64_t first_frame,
                                                            const AccuracyConfig& config) {
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, devices::OpenRecording(path));
  if (!recording.scene || !recording.scene->marker.family || !recording.scene->marker.id) {
    return InputError(path, "does not say which marker its ground truth is of",
                      "name family and id of the marker in its scene");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const Trajectory truth, ReadTruth(path));
  OwnDetectorOptions options{.measure_prints = config.measure == "print",
                             .spoil_corners_px = config.spoil_corners_px};
  PLEINAIR_ASSIGN_OR_RETURN(options.tracker, TrackingOf(*recording.scene));
  const auto detector = MakeOwnDetector(recording.camera, options);
  PLEINAIR_RETURN_IF_ERROR(detector->Start(true));
  const Anchor anchor{*recording.scene->marker.id, Metres(recording.scene->marker.size_m)};
  const double period_s = recording.frame_rate_hz > 0.0 ? 1.0 / recording.frame_rate_hz : 0.04;
  const auto reach_ns = static_cast<std::int64_t>(0.25e9 * period_s);
  std::vector<accuracy::FrameRecord> records;
  for (int index = 0;; ++index) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<devices::Frame> frame, recording.frames->Next());
    if (!frame) break;
    // The tracker follows through frames whose truth is not known, too.
    PLEINAIR_ASSIGN_OR_RETURN(accuracy::Detector::Seen seen, detector->Detect(frame->grey.view()));
    const TimedPose* pose = PoseAt(truth, frame->timestamp_ns, reach_ns);
    if (pose == nullptr) continue;
    const auto marker = TruthOf(recording.camera, anchor, *pose);
    if (!marker) continue;
    accuracy::FrameRecord record{.frame = first_frame + index,
                                 .name = fmt::format("{}_{:04}", path, index),
                                 .sweep = "recording",
                                 .pattern = path,
                                 .repeat = index,
                                 .detector = kOwnName};
    accuracy::Score({*marker}, seen.markers, &record);
    record.lost = seen.lost;
    record.stages_ms = std::move(seen.stages_ms);
    records.push_back(std::move(record));
  }
  if (records.empty()) {
    return InputError(path, "its ground truth has no pose at the time of any frame",
                      "give times in seconds since the recording's start");
  }
  return records;
}

std::optional<GreyImage> RecordedPicture(const std::string& path, std::int64_t index) {
  auto recording = devices::OpenRecording(path);
  if (!recording) return std::nullopt;
  for (std::int64_t i = 0;; ++i) {
    auto frame = recording->frames->Next();
    if (!frame || !*frame) return std::nullopt;
    if (i == index) return std::move((*frame)->grey);
  }
}

}  // namespace pleinair::app
