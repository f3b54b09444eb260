#include "session/marker_tracks.h"

#include <algorithm>
#include <cmath>

namespace pleinair::session {
namespace {

// Minimum ratio at which the image hardly separates the two planar solutions. The camera's last
// pose is then more reliable.
constexpr double kAmbiguousRatio = 0.05;
// A last pose older than this does not predict the next one.
constexpr std::int64_t kMemoryNs = 500'000'000;

/// Distance of two poses in metres. A radian counts as the distance to the marker.
double PoseDistance(const Transform<Camera, Marker>& a, const Transform<Camera, Marker>& b) {
  return Norm(a.translation_m - b.translation_m) +
         RotationAngle(a.rotation, b.rotation) * Norm(b.translation_m);
}

}  // namespace

double RotationAngle(const Mat3& a, const Mat3& b) {
  const Mat3 relative = a.Transposed() * b;
  const Vec3 twice_sine_axis{relative(2, 1) - relative(1, 2), relative(0, 2) - relative(2, 0),
                             relative(1, 0) - relative(0, 1)};
  const double trace = relative(0, 0) + relative(1, 1) + relative(2, 2);
  return std::atan2(Norm(twice_sine_axis), trace - 1.0);
}

std::optional<MarkerName> NameOfDetected(const tracker::MarkerDetection& detection) {
  if (!detection.id) return std::nullopt;
  return MarkerName{detection.family, *detection.id};
}

void MarkerTracks::AddFrame(std::int64_t frame_index, std::int64_t timestamp_ns,
                            const std::vector<tracker::MarkerObservation>& marker_observations) {
  ++frames_;
  frame_times_.push_back({frame_index, timestamp_ns});
  std::map<MarkerName, std::vector<Observation>> candidates;
  bool duplicates = false;
  for (const tracker::MarkerObservation& marker_observation : marker_observations) {
    const std::optional<MarkerName> name = NameOfDetected(marker_observation.detection);
    if (!name) continue;
    std::vector<Observation>& of_marker = candidates[*name];
    duplicates = duplicates || !of_marker.empty();
    const tracker::PoseEstimate& pose = marker_observation.pose;
    std::vector<std::uint8_t> visibility;
    for (const float seen : marker_observation.detection.visibility) {
      visibility.push_back(
          static_cast<std::uint8_t>(std::lround(std::clamp(seen, 0.0F, 1.0F) * 255.0F)));
    }
    const auto add = [&](const tracker::PoseSolution& solution) {
      of_marker.push_back(
          {frame_index, timestamp_ns, solution.camera_from_marker, solution.reprojection_rms_px,
           pose.ambiguity_ratio, marker_observation.detection.visible_fraction,
           marker_observation.detection.path, marker_observation.detection.visibility_side,
           visibility, marker_observation.detection.corners_px});
    };
    add(pose.best);
    if (pose.alternative && pose.ambiguity_ratio > kAmbiguousRatio) add(*pose.alternative);
  }
  if (duplicates) ++frames_with_duplicates_;
  for (const auto& [marker, options] : candidates) {
    std::vector<Observation>& path = tracks_[marker];
    auto chosen = options.begin();
    if (!path.empty() && timestamp_ns - path.back().timestamp_ns <= kMemoryNs) {
      const Transform<Camera, Marker>& last = path.back().camera_from_marker;
      chosen = std::min_element(options.begin(), options.end(), [&](const auto& a, const auto& b) {
        return PoseDistance(a.camera_from_marker, last) < PoseDistance(b.camera_from_marker, last);
      });
    }
    path.push_back(*chosen);
  }
}

void MarkerTracks::ForgetAllBut(std::size_t observations) {
  const auto forget = [&](auto& all) {
    if (all.size() <= observations) return;
    all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(observations));
  };
  for (auto& [marker, path] : tracks_) forget(path);
  forget(frame_times_);
}

bool MayBeReferenceMarker(const MarkerName& marker, const scene::MarkerDescription& declared) {
  return marker.family == declared.family.value_or(marker.family) &&
         marker.id == declared.id.value_or(marker.id);
}

std::optional<MarkerName> MarkerTracks::ReferenceMarker() const {
  std::optional<MarkerName> most;
  std::size_t marker_observations = 0;
  for (const auto& [marker, path] : tracks_) {
    if (!MayBeReferenceMarker(marker, declared_) || path.size() <= marker_observations) continue;
    most = marker;
    marker_observations = path.size();
  }
  return most;
}

const std::vector<Observation>& MarkerTracks::TrackOf(const MarkerName& marker) const {
  static const std::vector<Observation> kNever;
  const auto found = tracks_.find(marker);
  return found == tracks_.end() ? kNever : found->second;
}

}  // namespace pleinair::session
