#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "session/trajectory/follow_trajectory.h"
#include "tracker/observation.h"
#include "tracker/pose/anchor_fit.h"

namespace pleinair::session {

/// An anchor (a marker that does not move against the reference marker), with its pose.
struct PlacedAnchor {
  MarkerName marker;
  std::int64_t frames = 0;  ///< Number of frames that show it.
  bool is_given = false;    ///< Its pose is the scene's.
  /// Nothing: no frame shows it beside a placed marker, so it is not used.
  std::optional<Transform<Marker, Marker>> reference_from_anchor;
};

/// How the anchors of a scene were used.
struct AnchorSummary {
  std::vector<PlacedAnchor> anchors;
  std::int64_t by_anchors = 0;  ///< Frames without the reference marker whose pose anchors give.
  std::int64_t filled = 0;      ///< Frames without any marker, filled by the camera's motion.
  std::int64_t gaps = 0;
  double longest_gap_s = 0.0;
};

/// The trajectory of the camera by all markers of a scene, or by a given trajectory.
struct AnchoredPath {
  std::vector<Observation> observations;  ///< One per frame with a pose.
  AnchorSummary summary;
  std::optional<TrajectorySummary> trajectory{};  ///< Nothing: none was given.
};

/// Name of an anchor's marker.
MarkerName NameOf(const scene::AnchorDescription& anchor);

/// The tracker takes all markers for as large as the reference marker. Scales the poses of anchors
/// of another size.
void ScaleAnchors(const scene::SceneDescription& scene,
                  std::vector<tracker::MarkerObservation>* observations);

/// The reference marker and the anchors of a scene, with the places that the scene gives.
std::vector<tracker::AnchorMarker> DescribedAnchors(const scene::SceneDescription& scene);

/// The markers of a scene that one frame shows.
struct AnchorView {
  tracker::AnchorFrame markers;
  Observation observation;  ///< The reference marker's, or that of the first anchor.
};

/// Adds a marker of a frame, in the order of DescribedAnchors(). `marker`: its index there.
void AddToView(std::size_t marker, const Observation& seen, AnchorView* view);

/// The observation of a frame with the pose by all placed markers that it shows. Nothing if it
/// shows none. A frame with the reference marker alone keeps that marker's pose.
std::optional<Observation> ObservationBy(const CameraModel& camera,
                                         const std::vector<tracker::AnchorMarker>& markers,
                                         AnchorView view);

/// Estimates the trajectory of the camera from all markers of a scene. First it places the anchors
/// that have no pose (tracker/pose/anchor_fit.h). Then it estimates the pose of each frame from all
/// markers that it shows. It fills short gaps (path_gaps.h). `camera`: the lens of the frames.
AnchoredPath FollowAnchors(const CameraModel& camera, const scene::SceneDescription& scene,
                           const MarkerTracks& tracks, const MarkerName& reference);

}  // namespace pleinair::session
