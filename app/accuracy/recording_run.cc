#include "app/accuracy/recording_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "accuracy/marker_pose.h"
#include "accuracy/scoring.h"
#include "app/accuracy/own_detector.h"
#include "app/accuracy/recording_truth.h"
#include "devices/recordings/recording.h"
#include "session/scene_marker.h"

namespace pleinair::app {
namespace {

using accuracy::Detector;
using accuracy::FrameRecord;
using accuracy::MarkerTruth;

/// Our detector's observations in a frame.
struct SeenFrame {
  std::int64_t index = 0, timestamp_ns = 0;
  Detector::Detections seen;
};

/// The marker with ground truth.
struct ReferenceMarker {
  std::string family;
  int number = 0;
  Metres size;
  bool is_named = false;  ///< The scene names it.

  bool Is(const accuracy::Detected& detected) const {
    return detected.family == family && detected.number == number;
  }
};

std::unique_ptr<Detector> MakePeer(const std::string& name, const CameraModel& camera,
                                   const ReferenceMarker& reference_marker) {
  return name == "apriltag"
             ? accuracy::MakeAprilTagPeer(camera, reference_marker.family, reference_marker.size)
             : accuracy::MakeArucoPeer(camera, reference_marker.family, reference_marker.size);
}

/// Processes one recording, from opening it to the records.
class RecordingRun {
 public:
  RecordingRun(const std::string& path, std::int64_t first_frame, const AccuracyConfig& config)
      : path_(path), first_frame_(first_frame), config_(config) {}

  Result<std::vector<FrameRecord>> Measure() {
    PLEINAIR_RETURN_IF_ERROR(LookThrough());
    PLEINAIR_RETURN_IF_ERROR(ChooseReferenceMarker());
    PLEINAIR_RETURN_IF_ERROR(FindTruth());
    for (SeenFrame& frame : frames_) {
      if (truth_.contains(frame.index)) AddRecord(kOwnName, frame.index, std::move(frame.seen));
    }
    for (const std::string& name : config_.peers) PLEINAIR_RETURN_IF_ERROR(MeasurePeer(name));
    return std::move(records_);
  }

 private:
  /// Runs our detector on all frames: it also tracks through those without ground truth.
  Result<void> LookThrough() {
    PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, devices::OpenRecording(path_));
    if (!recording.scene || recording.scene->marker.size_m <= 0.0) {
      return InputError(path_,
                        "does not give the size of the marker that its ground truth refers to",
                        "name size, and better family and id too, of the marker in its scene");
    }
    scene_ = *recording.scene;
    camera_ = recording.camera;
    period_ns_ = std::llround(recording.frame_rate_hz > 0.0 ? 1e9 / recording.frame_rate_hz : 4e7);
    OwnDetectorOptions options{.measure_prints = config_.measure == "print",
                               .spoil_corners_px = config_.spoil_corners_px};
    PLEINAIR_ASSIGN_OR_RETURN(options.tracker, session::TrackingOf(scene_));
    const auto detector = MakeOwnDetector(camera_, options);
    PLEINAIR_RETURN_IF_ERROR(detector->Start(true));
    for (std::int64_t index = 0;; ++index) {
      PLEINAIR_ASSIGN_OR_RETURN(const auto frame, recording.frames->Next());
      if (!frame) return {};
      if (index == 0 && frame->device_timestamp_ns) {
        start_ns_ = *frame->device_timestamp_ns - frame->timestamp_ns;
      }
      PLEINAIR_ASSIGN_OR_RETURN(Detector::Detections seen, detector->Detect(frame->grey.view()));
      frames_.push_back({index, frame->timestamp_ns, std::move(seen)});
    }
  }

  Result<void> ChooseReferenceMarker() {
    anchor_.size = Metres(scene_.marker.size_m);
    std::map<std::pair<std::string, int>, int> observations;
    for (const SeenFrame& frame : frames_) {
      for (const accuracy::Detected& detected : frame.seen.markers) {
        if (scene_.marker.family && *scene_.marker.family != detected.family) continue;
        if (scene_.marker.id && *scene_.marker.id != detected.number) continue;
        ++observations[{detected.family, detected.number}];
      }
    }
    anchor_.is_named = scene_.marker.family && scene_.marker.id;
    if (anchor_.is_named) {
      anchor_.family = *scene_.marker.family;
      anchor_.number = *scene_.marker.id;
      return {};
    }
    const auto most =
        std::max_element(observations.begin(), observations.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (most == observations.end()) {
      return InputError(path_, "no marker was found in it, and its scene names none",
                        "name family and id of the marker in its scene");
    }
    std::tie(anchor_.family, anchor_.number) = most->first;
    return {};
  }

  /// Stamps from 2001 on count from 1970, others from the start of the recording.
  std::int64_t SinceStart(std::int64_t timestamp_ns) const {
    constexpr std::int64_t kLate_ns = 1'000'000'000'000'000'000;
    if (timestamp_ns < kLate_ns) return timestamp_ns;
    return timestamp_ns - start_ns_.value_or(scene_.place_time.start.nanoseconds_since_1970());
  }

  Result<void> FindTruth() {
    PLEINAIR_ASSIGN_OR_RETURN(RecordingTruth truth, ReadRecordingTruth(path_));
    for (exports::TrajectoryPose& pose : truth.poses)
      pose.timestamp_ns = SinceStart(pose.timestamp_ns);
    Transform<Marker, exports::Reference> marker_from_reference;
    is_aligned_ = !truth.in_marker_frame;
    if (is_aligned_) {
      const auto aligned = AlignReference(PairsWith(truth.poses));
      if (!aligned) {
        return InputError(path_, "its marker is found at no moment of the ground truth",
                          "give times in seconds since the recording's start, or since 1970");
      }
      marker_from_reference = *aligned;
    }
    for (const SeenFrame& frame : frames_) {
      const auto pose = PoseAt(truth.poses, frame.timestamp_ns, period_ns_);
      if (!pose) continue;
      const auto marker = TruthOf((marker_from_reference * *pose).Inverse());
      if (marker) truth_.emplace(frame.index, *marker);
    }
    if (!truth_.empty()) return {};
    return InputError(path_, "its ground truth has no pose at the time of any frame",
                      "give times in seconds since the recording's start, or since 1970");
  }

  std::vector<PosePair> PairsWith(const std::vector<exports::TrajectoryPose>& truth) const {
    std::vector<PosePair> pairs;
    for (const SeenFrame& frame : frames_) {
      const auto pose = PoseAt(truth, frame.timestamp_ns, period_ns_);
      if (!pose) continue;
      for (const accuracy::Detected& detected : frame.seen.markers) {
        if (!anchor_.Is(detected) || !detected.pose) continue;
        pairs.push_back({detected.pose->best.camera_from_marker.Inverse(), *pose});
        break;
      }
    }
    return pairs;
  }

  std::optional<MarkerTruth> TruthOf(const Transform<Camera, Marker>& camera_from_marker) const {
    MarkerTruth truth{.number = anchor_.number, .camera_from_marker = camera_from_marker};
    for (const Vec2 corner : {Vec2{-1, 1}, Vec2{1, 1}, Vec2{1, -1}, Vec2{-1, -1}}) {
      const Vec2 at = corner * (0.5 * anchor_.size.value());
      if ((camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}}).xyz.z <= 0.0) {
        return std::nullopt;
      }
    }
    truth.corners_px = accuracy::SquareCorners(camera_, camera_from_marker, anchor_.size);
    return truth;
  }

  void AddRecord(const std::string& detector, std::int64_t index, Detector::Detections seen) {
    if (!anchor_.is_named) {
      std::erase_if(seen.markers, [&](const accuracy::Detected& detected) {
        return detector == kOwnName ? !anchor_.Is(detected) : detected.number != anchor_.number;
      });
    }
    FrameRecord record{.frame = first_frame_ + index,
                       .name = fmt::format("{}_{:04}", path_, index),
                       .sweep = accuracy::kRecordingSweep,
                       .pattern = path_,
                       .repeat = static_cast<int>(index),
                       .detector = detector,
                       .truth_aligned = is_aligned_};
    accuracy::Score({truth_.at(index)}, seen.markers, &record);
    record.lost = seen.lost;
    record.stages_ms = std::move(seen.stages_ms);
    records_.push_back(std::move(record));
  }

  Result<void> MeasurePeer(const std::string& name) {
    const auto detector = MakePeer(name, camera_, anchor_);
    if (detector == nullptr) return {};  // The report lists that it had no marker to decode.
    PLEINAIR_RETURN_IF_ERROR(detector->Start(true));
    PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, devices::OpenRecording(path_));
    for (std::int64_t index = 0;; ++index) {
      PLEINAIR_ASSIGN_OR_RETURN(const auto frame, recording.frames->Next());
      if (!frame) return {};
      if (!truth_.contains(index)) continue;
      PLEINAIR_ASSIGN_OR_RETURN(Detector::Detections seen, detector->Detect(frame->grey.view()));
      AddRecord(name, index, std::move(seen));
    }
  }

  const std::string& path_;
  const std::int64_t first_frame_;
  const AccuracyConfig& config_;
  scene::SceneDescription scene_;
  CameraModel camera_;
  std::int64_t period_ns_ = 0;
  std::optional<std::int64_t>
      start_ns_;  ///< Start of the recording, by the stamps of its own clock.
  std::vector<SeenFrame> frames_;
  ReferenceMarker anchor_;
  bool is_aligned_ = false;
  std::map<std::int64_t, MarkerTruth> truth_;  ///< By frame.
  std::vector<FrameRecord> records_;
};

}  // namespace

Result<std::vector<FrameRecord>> MeasureRecording(const std::string& path, std::int64_t first_frame,
                                                  const AccuracyConfig& config) {
  return RecordingRun(path, first_frame, config).Measure();
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
