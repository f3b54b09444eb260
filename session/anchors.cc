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

/// The markers of all frames, in order of the frames.
std::vector<AnchorView> FilmOf(const MarkerTracks& tracks, const std::vector<MarkerName>& names) {
  std::map<std::int64_t, AnchorView> by_frame;
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const Observation& seen : tracks.TrackOf(names[i])) {
      AddToView(i, seen, &by_frame[seen.frame_index]);
    }
  }
  std::vector<AnchorView> film;
  film.reserve(by_frame.size());
  for (auto& [index, view] : by_frame) film.push_back(std::move(view));
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

std::vector<tracker::AnchorMarker> DescribedAnchors(const scene::SceneDescription& scene) {
  const Transform<Marker, Marker> same;
  std::vector<tracker::AnchorMarker> markers{{scene.marker.size_m, same}};
  for (const scene::AnchorDescription& anchor : scene.anchors) {
    markers.push_back({anchor.size_m, {}});
    if (!anchor.place) continue;
    markers.back().reference_from_marker = Transform<Marker, Marker>{
        RotationXyz(anchor.place->rotation_deg), anchor.place->translation_m};
  }
  return markers;
}

void AddToView(std::size_t marker, const Observation& seen, AnchorView* view) {
  const bool is_first = view->markers.empty();
  view->markers.push_back({marker, seen.corners_px, CornerDeviation_px(seen.visible_fraction),
                           seen.camera_from_marker});
  if (!is_first) return;
  view->observation = seen;
  if (marker == 0) return;
  // Its visibility map is that of another marker.
  view->observation.visibility_side = 0;
  view->observation.visibility.clear();
  view->observation.source = PoseSource::kAnchors;
}

std::optional<Observation> ObservationBy(const CameraModel& camera,
                                         const std::vector<tracker::AnchorMarker>& markers,
                                         AnchorView view) {
  Observation& here = view.observation;
  const bool alone = here.source == PoseSource::kMarker && view.markers.size() == 1;
  if (alone) return std::move(here);
  const auto pose = tracker::FitAnchoredPose(camera, markers, view.markers);
  if (pose) {
    here.camera_from_marker = pose->camera_from_reference;
    here.reprojection_rms_px = pose->reprojection_rms_px;
  } else if (here.source != PoseSource::kMarker) {
    return std::nullopt;
  }
  // Anchors that contradict it do not take the reference marker's own pose away.
  return std::move(here);
}

AnchoredPath FollowAnchors(const CameraModel& camera, const scene::SceneDescription& scene,
                           const MarkerTracks& tracks, const MarkerName& reference) {
  std::vector<MarkerName> names{reference};
  for (const scene::AnchorDescription& anchor : scene.anchors) names.push_back(NameOf(anchor));
  std::vector<tracker::AnchorMarker> markers = DescribedAnchors(scene);
  std::vector<AnchorView> film = FilmOf(tracks, names);
  std::vector<tracker::AnchorFrame> frames;
  frames.reserve(film.size());
  for (const AnchorView& view : film) frames.push_back(view.markers);
  tracker::PlaceAnchorMarkers(camera, frames, &markers);
  AnchoredPath path;
  AnchorSummary& summary = path.summary;
  for (AnchorView& view : film) {
    auto observation = ObservationBy(camera, markers, std::move(view));
    if (!observation) continue;
    summary.by_anchors += observation->source == PoseSource::kAnchors ? 1 : 0;
    path.observations.push_back(*std::move(observation));
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
