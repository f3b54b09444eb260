#include "session/anchors.h"

#include <cstddef>
#include <map>
#include <utility>

#include "session/corner_deviation.h"
#include "session/path_gaps.h"
#include "session/scene_edit.h"
#include "tracker/pose/anchor_fit.h"

namespace pleinair::session {
namespace {

/// The markers of all frames, by index of the frame.
struct AnchorFilm {
  std::vector<tracker::AnchorFrame> frames;
  std::vector<Observation> observations;  ///< The reference marker's, or the frame's first.
};

AnchorFilm FilmOf(const MarkerTracks& tracks, const std::vector<MarkerName>& names) {
  std::map<std::int64_t, std::pair<tracker::AnchorFrame, Observation>> by_frame;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const Observation& seen : tracks.TrackOf(names[i])) {
      auto [at, is_new] = by_frame.try_emplace(seen.frame_index);
      at->second.first.push_back(
          {i, seen.corners_px, CornerDeviation_px(seen.visible_fraction), seen.camera_from_marker});
      if (!is_new) continue;
      at->second.second = seen;
      if (i == 0) continue;
      // Its visibility map is that of another marker.
      at->second.second.visibility_side = 0;
      at->second.second.visibility.clear();
      at->second.second.source = PoseSource::kAnchors;
    }
  }
  AnchorFilm film;
  for (auto& [index, frame] : by_frame) {
    film.frames.push_back(std::move(frame.first));
    film.observations.push_back(std::move(frame.second));
  }
  return film;
}

}  // namespace

MarkerName NameOf(const scene::AnchorDescription& anchor) { return {anchor.family, anchor.id}; }

void ScaleAnchors(const scene::SceneDescription& scene,
                  std::vector<tracker::MarkerObservation>* observations) {
  for (const scene::AnchorDescription& anchor : scene.anchors) {
    const double scale = anchor.size_m / scene.marker.size_m;
    if (scale == 1.0) continue;
    for (tracker::MarkerObservation& observation : *observations) {
      if (observation.detection.family != anchor.family || observation.detection.id != anchor.id) {
        continue;
      }
      tracker::PoseEstimate& pose = observation.pose;
      Vec3& best = pose.best.camera_from_marker.translation_m;
      best = best * scale;
      if (pose.alternative) {
        Vec3& other = pose.alternative->camera_from_marker.translation_m;
        other = other * scale;
      }
      for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t column = 0; column < 6; ++column) {
          if (row >= 3) pose.covariance[6 * row + column] *= scale;
          if (column >= 3) pose.covariance[6 * row + column] *= scale;
        }
      }
    }
  }
}

AnchoredPath FollowAnchors(const CameraModel& camera, const scene::SceneDescription& scene,
                           const MarkerTracks& tracks, const MarkerName& reference) {
  const Transform<Marker, Marker> same;
  std::vector<MarkerName> names{reference};
  std::vector<tracker::AnchorMarker> markers{{scene.marker.size_m, same}};
  for (const scene::AnchorDescription& anchor : scene.anchors) {
    names.push_back(NameOf(anchor));
    markers.push_back({anchor.size_m, {}});
    if (!anchor.place) continue;
    markers.back().reference_from_marker = Transform<Marker, Marker>{
        RotationXyz(anchor.place->rotation_deg), anchor.place->translation_m};
  }
  AnchorFilm film = FilmOf(tracks, names);
  tracker::PlaceAnchorMarkers(camera, film.frames, &markers);
  AnchoredPath path;
  AnchorSummary& summary = path.summary;
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    Observation& here = film.observations[i];
    const bool alone = here.source == PoseSource::kMarker && film.frames[i].size() == 1;
    if (!alone) {
      const auto pose = tracker::FitAnchoredPose(camera, markers, film.frames[i]);
      // Anchors that contradict it do not take the reference marker's own pose away.
      if (!pose && here.source != PoseSource::kMarker) continue;
      here.camera_from_marker = pose->camera_from_reference;
      here.reprojection_rms_px = pose->reprojection_rms_px;
    }
    summary.by_anchors += here.source == PoseSource::kAnchors ? 1 : 0;
    path.observations.push_back(std::move(here));
  }
  const FilledGaps filled = FillGaps(tracks.frame_times(), &path.observations);
  summary.filled = filled.frames;
  summary.gaps = filled.gaps;
  summary.longest_gap_s = filled.longest_s;
  for (std::size_t i = 1; i < names.size(); ++i) {
    summary.anchors.push_back({names[i], static_cast<std::int64_t>(tracks.TrackOf(names[i]).size()),
                               scene.anchors[i - 1].place.has_value(),
                               markers[i].reference_from_marker});
  }
  return path;
}

}  // namespace pleinair::session
