#pragma once

#include <cstddef>
#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "tracker/pose/anchor_fit.h"

namespace pleinair::session {

/// Estimates the pose of the camera from all markers of a scene, frame by frame, for sessions that
/// do not know their later frames. FollowAnchors() does so for a whole recording.
///
/// The places of anchors that the scene does not give come from the frames so far that show them
/// beside another placed marker. They are estimated again whenever the number of these frames has
/// doubled, up to 64 per anchor, and then stay. This takes up to a few hundred milliseconds. In the
/// background, frames keep the last places until the new ones are known. No gap is filled.
class AnchorFollower {
 public:
  /// `camera`: the lens of the frames. `scene`: with a number of its marker.
  /// `in_background`: places are estimated on another thread.
  AnchorFollower(const CameraModel& camera, const scene::SceneDescription& scene,
                 bool in_background = false);

  /// Adds the frame that was added to `tracks` last. Returns the observation of the reference
  /// marker: its own if the frame shows no other placed marker, else with the pose by all of them.
  /// Nothing if the frame shows no placed marker. Costs some 0.1 ms, besides the
  /// estimate of places.
  std::optional<Observation> Add(const MarkerTracks& tracks, std::int64_t frame_index);

  /// The reference marker.
  const MarkerName& reference() const { return names_[0]; }

 private:
  void Keep(const tracker::AnchorFrame& frame);
  void Place();

  CameraModel camera_;
  // The reference marker, then the anchors.
  std::vector<MarkerName> names_;
  std::vector<tracker::AnchorMarker> described_, placed_;
  std::vector<std::size_t> shared_frames_;    // Per marker: the frames that show it beside another.
  std::vector<tracker::AnchorFrame> shared_;  // These frames.
  const bool in_background_;
  bool is_due_ = false;  // The places are to be estimated again.
  std::future<std::vector<tracker::AnchorMarker>> placing_;
};

}  // namespace pleinair::session
