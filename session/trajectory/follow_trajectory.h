#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "session/trajectory/given_trajectory.h"
#include "session/trajectory/trajectory_alignment.h"
#include "session/trajectory/trajectory_offset.h"

namespace pleinair::session {

/// Numbers of frames by the source of their pose.
struct TrajectoryFrames {
  std::int64_t by_trajectory = 0;
  std::int64_t without_marker = 0;  ///< Part of by_trajectory: frames without the marker.
  std::int64_t by_marker = 0;       ///< Outside the trajectory: by the marker's own pose.
  std::int64_t filled = 0;          ///< In gaps: by the camera's motion on both sides.
  std::int64_t missing = 0;         ///< Without a pose.
};

/// How a given trajectory was used.
struct TrajectorySummary {
  std::string file;
  bool by_frame = false, by_points = false, is_metric = false;
  TrajectoryOffset offset;
  TrajectoryAlignment alignment;
  TrajectoryFrames frames;
  /// Root mean square distance of the marker's corners from their places by the trajectory, over
  /// all frames that show it. Nothing: no such frame.
  std::optional<double> marker_rms_px;
  double centre_deviation_m = 0.0;  ///< Median over the frames by the trajectory.
  /// Angle between the trajectory's upward direction and the scene's; nothing: the format has none.
  std::optional<Radians> tilt;
};

/// The camera's poses in the marker's frame, from a given trajectory.
struct FollowedTrajectory {
  std::vector<Observation> observations;  ///< One per frame with a pose.
  TrajectorySummary summary;
};

/// What is known of a frame's marker, with the pose by an aligned trajectory. `seen`: the marker in
/// this frame; null if the frame does not show it.
Observation ObservationByTrajectory(const CameraModel& camera, double marker_size_m,
                                    const FrameTime& time, const Observation* seen,
                                    const TrajectoryAlignment& alignment,
                                    const Transform<TrajectoryWorld, Camera>& world_from_camera);

/// Returns the camera's pose of every frame by a given trajectory: estimates the offset of its
/// clock and aligns it with the marker's frame. A frame that the trajectory covers has its pose
/// from it, with and without marker, so that nothing jumps where the marker leaves the view. Other
/// frames keep the pose of `marker_path`, and short gaps are filled (session/path_gaps.h). `track`:
/// the frames that show the reference marker. Errors: those of AlignByMarker() and AlignByPoints().
/// The trajectory has a pose for no frame. In the median, it puts the marker farther than half its
/// edge from where frames show it. The marker is a picture target and no places are given.
Result<FollowedTrajectory> FollowTrajectory(const CameraModel& camera,
                                            const scene::MarkerDescription& marker,
                                            const std::vector<FrameTime>& times,
                                            const std::vector<Observation>& track,
                                            const std::vector<Observation>& marker_path,
                                            const TrajectoryRequest& request);

}  // namespace pleinair::session
