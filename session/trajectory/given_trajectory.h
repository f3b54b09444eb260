#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "session/marker_tracks.h"

namespace pleinair::session {

/// Frame of reference of a given trajectory: right-handed, its author's choice. Its unit is the
/// metre, or any length.
struct TrajectoryWorld;

/// Pose of the camera in a given trajectory.
struct GivenPose {
  std::int64_t timestamp_ns = 0;            ///< By the trajectory's own clock.
  std::optional<std::int64_t> frame_index;  ///< Number of the film's frame, if known.
  /// Camera as in base/frames.h; lengths in the trajectory's unit.
  Transform<TrajectoryWorld, Camera> world_from_camera;
};

/// A camera trajectory that another program has estimated.
struct GivenTrajectory {
  std::string file;              ///< For messages.
  std::vector<GivenPose> poses;  ///< Times ascend, and numbers of frames where they are known.
  bool is_metric = false;        ///< The unit of length is the metre.
  std::optional<Vec3> up;        ///< Upward direction, where the format defines one.
  bool by_frame = false;         ///< Poses belong to frames by number, not by time.
  /// Longest time between two poses across which a pose is interpolated, seconds.
  double max_gap_s = 0.2;
};

/// The pose at a time of the trajectory's clock. Between two neighbours, positions are interpolated
/// linearly and rotations along the shortest arc (Shoemake 1985, "Animating rotation with
/// quaternion curves"). Nothing more than 1 ms outside the trajectory, and between poses that are
/// farther apart than max_gap_s.
std::optional<Transform<TrajectoryWorld, Camera>> PoseAtTime(const GivenTrajectory& trajectory,
                                                             std::int64_t timestamp_ns);

/// The pose of a frame, by its number. Nothing if the trajectory has none.
std::optional<Transform<TrajectoryWorld, Camera>> PoseOfFrame(const GivenTrajectory& trajectory,
                                                              std::int64_t frame_index);

/// The pose of a frame: by its number, or by its time. `offset_ns`: time of the recording minus
/// time of the trajectory.
std::optional<Transform<TrajectoryWorld, Camera>> PoseIn(const GivenTrajectory& trajectory,
                                                         std::int64_t frame_index,
                                                         std::int64_t timestamp_ns,
                                                         std::int64_t offset_ns);

/// A place that is known both in the trajectory's frame of reference and in the marker's.
struct PointPair {
  Point<TrajectoryWorld> in_trajectory;  ///< In the trajectory's unit.
  Point<Marker> in_scene;                ///< Metres.
};

/// A given trajectory, with what matches its clock and aligns it.
struct TrajectoryRequest {
  GivenTrajectory trajectory;
  /// Time of the recording minus time of the trajectory; nothing: estimated.
  std::optional<std::int64_t> offset_ns;
  /// Time of the recording's start by the camera's own clock, which the trajectory may share.
  std::optional<std::int64_t> clock_start_ns{};
  /// Places that align the trajectory; empty: the frames that show the marker align it.
  std::vector<PointPair> points{};
  /// Further views of the reference marker, in order of frames, where only a sample of the
  /// recording is tracked. They count for offset and alignment, and get no pose.
  std::vector<Observation> more_views{};
};

}  // namespace pleinair::session
