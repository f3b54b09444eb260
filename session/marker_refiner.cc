#include "session/marker_refiner.h"

#include <cstddef>
#include <utility>

#include "base/parallel_for.h"
#include "base/units.h"
#include "session/scene_marker.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::session {
namespace {

/// S-G markers with a number. Without it, most of the pattern is unknown.
bool IsMeasured(const tracker::MarkerDetection& detection) {
  return detection.family == kSgFamily && detection.id;
}

}  // namespace

void MarkerRefiner::Measure(std::span<Seen> frames) {
  for (const Seen& seen : frames) {
    for (const tracker::MarkerObservation& observation : seen.observations) {
      if (!IsMeasured(observation.detection)) continue;
      const MarkerName name = *NameOfDetected(observation.detection);
      Marker& marker = markers_[name];
      if (!marker.pattern) marker.pattern = PatternOf(name);
    }
  }
  std::vector<Alignments> alignments(frames.size());
  ParallelFor(frames.size(), 0, [&](std::size_t i) { alignments[i] = Align(frames[i]); });
  // Each pose starts from the one before.
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t k = 0; k < frames[i].observations.size(); ++k) {
      tracker::MarkerObservation& observation = frames[i].observations[k];
      if (IsMeasured(observation.detection)) TakeOver(alignments[i][k], &observation);
    }
  }
}

std::vector<tracker::MarkerObservation> MarkerRefiner::Measure(
    ImageView<const std::uint8_t> grey, std::vector<tracker::MarkerObservation> observations) {
  Seen seen{grey, std::move(observations)};
  Measure({&seen, 1});
  return std::move(seen.observations);
}

MarkerRefiner::Alignments MarkerRefiner::Align(const Seen& seen) const {
  Alignments alignments(seen.observations.size());
  for (std::size_t k = 0; k < alignments.size(); ++k) {
    const tracker::MarkerDetection& detection = seen.observations[k].detection;
    if (!IsMeasured(detection)) continue;
    const Marker& marker = markers_.at(*NameOfDetected(detection));
    alignments[k] = tracker::AlignMarker(camera_, *marker.pattern, seen.grey, detection.corners_px,
                                         {detection.visibility_side, detection.visibility});
  }
  return alignments;
}

void MarkerRefiner::TakeOver(const std::optional<tracker::MarkerAlignment>& alignment,
                             tracker::MarkerObservation* observation) {
  tracker::MarkerDetection& detection = observation->detection;
  Marker& marker = markers_.at(*NameOfDetected(detection));
  if (alignment) {
    const std::optional<tracker::PoseEstimate> pose = tracker::EstimatePlanarPose(
        camera_, alignment->corners_px, alignment->corner_covariance_px2, Metres(marker_size_m_),
        marker.seen ? &marker.last_rotation : nullptr);
    if (pose) {
      // The visible share stays the tracker's: its blocks measure it better where much is hidden.
      detection.corners_px = alignment->corners_px;
      observation->pose = *pose;
    }
  }
  marker.last_rotation = observation->pose.best.camera_from_marker.rotation;
  marker.seen = true;
}

}  // namespace pleinair::session
