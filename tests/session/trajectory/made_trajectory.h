#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "session/marker_tracks.h"
#include "session/trajectory/given_trajectory.h"
#include "tests/session/phone_camera.h"

namespace pleinair::session {

/// Made test data: a walk past a marker, and the camera's trajectory as another program estimates
/// it.
class MadeTrajectory {
 public:
  static constexpr double kMarkerSize_m = 0.3, kFrameRate_hz = 30.0;
  static constexpr int kFrames = 120;

  MadeTrajectory();

  const CameraModel& camera() const { return camera_; }
  const std::vector<FrameTime>& times() const { return times_; }

  /// The true pose in a frame: somebody with a camera in the hand walks by, at two metres.
  static Transform<Camera, Marker> TruePose(double time_s);

  /// The marker in some frames, its corners with noise.
  std::vector<Observation> Seen(const std::vector<int>& frames, double noise_px = 0.03);

  /// The true trajectory in another frame of reference, by another clock. `unit_m`: metres of one
  /// of its units.
  GivenTrajectory Given(double unit_m, std::int64_t clock_ns = 0) const;

  /// Places in both frames of reference. `unit_m`: metres of one unit of the trajectory.
  std::vector<PointPair> Places(const std::vector<Vec3>& in_scene, double unit_m);

  /// Largest distance of the marker's centre and axes from their true places, as the camera sees
  /// them.
  struct Distance {
    double centre_m = 0.0, turn_rad = 0.0;
  };
  static Distance FarthestOf(const std::vector<Observation>& path);

 private:
  Transform<TrajectoryWorld, Marker> WorldFromMarker() const;

  CameraModel camera_ = PhoneLens();
  std::vector<FrameTime> times_;
  std::mt19937 random_{5};
};

}  // namespace pleinair::session
