#include "tests/session/trajectory/made_trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/session/phone_camera.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::session {
MadeTrajectory::MadeTrajectory() {
  for (int i = 0; i < kFrames; ++i) times_.push_back({i, std::llround(i * 1e9 / kFrameRate_hz)});
}

Transform<Camera, Marker> MadeTrajectory::TruePose(double time_s) {
  const double sway = 2.0 * std::numbers::pi * time_s;
  const Mat3 rotation = About(1, 0.1 * time_s - 0.2 + 0.02 * std::sin(1.3 * sway)) *
                        About(2, 0.02 * std::sin(0.7 * sway)) *
                        About(0, -2.3 + 0.02 * std::sin(0.9 * sway));
  return {rotation,
          {-0.3 - 0.05 * time_s + 0.02 * std::sin(1.1 * sway), 0.1 + 0.01 * std::sin(1.6 * sway),
           2.0 - 0.12 * time_s}};
}

std::vector<Observation> MadeTrajectory::Seen(const std::vector<int>& frames, double noise_px) {
  std::normal_distribution<double> noise(0.0, noise_px);
  constexpr std::array<Vec2, 4> kCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
  std::vector<Observation> track;
  for (const int i : frames) {
    Observation& seen = track.emplace_back();
    seen.frame_index = i;
    seen.timestamp_ns = times_[static_cast<std::size_t>(i)].timestamp_ns;
    const Transform<Camera, Marker> pose = TruePose(i / kFrameRate_hz);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec2 at = kCorners[k] * (0.5 * kMarkerSize_m);
      seen.corners_px[k] = ProjectToPixel(camera_, pose * Point<Marker>{{at.x, at.y, 0}}) +
                           Vec2{noise(random_), noise(random_)};
    }
    const auto estimate = tracker::EstimatePlanarPose(
        camera_, seen.corners_px, tracker::IsotropicCornerCovariance(std::max(noise_px, 0.01)),
        Metres(kMarkerSize_m), &pose.rotation);
    EXPECT_TRUE(estimate);
    if (estimate) seen.camera_from_marker = estimate->best.camera_from_marker;
  }
  return track;
}

Transform<TrajectoryWorld, Marker> MadeTrajectory::WorldFromMarker() const {
  return {About(0, 1.1) * About(2, -2.4), {3.0, -1.5, 0.7}};
}

GivenTrajectory MadeTrajectory::Given(double unit_m, std::int64_t clock_ns) const {
  GivenTrajectory given;
  given.file = "walk.tum";
  given.is_metric = unit_m == 1.0;
  // At times of its own, and beyond the film on both sides.
  constexpr double kPoseRate_hz = 47.0;
  for (int i = -20; i < kFrames * kPoseRate_hz / kFrameRate_hz + 20; ++i) {
    const double time_s = i / kPoseRate_hz;
    GivenPose pose;
    pose.timestamp_ns = clock_ns + std::llround(time_s * 1e9);
    pose.world_from_camera = WorldFromMarker() * TruePose(time_s).Inverse();
    pose.world_from_camera.translation_m = pose.world_from_camera.translation_m * (1.0 / unit_m);
    given.poses.push_back(pose);
  }
  return given;
}

std::vector<PointPair> MadeTrajectory::Places(const std::vector<Vec3>& in_scene, double unit_m) {
  std::vector<PointPair> places;
  for (const Vec3& place : in_scene) {
    const Point<TrajectoryWorld> moved = WorldFromMarker() * Point<Marker>{place};
    places.push_back({{moved.xyz * (1.0 / unit_m)}, {place}});
  }
  return places;
}

MadeTrajectory::Distance MadeTrajectory::FarthestOf(const std::vector<Observation>& path) {
  Distance farthest;
  for (const Observation& at : path) {
    const Transform<Camera, Marker> truth = TruePose(static_cast<double>(at.timestamp_ns) * 1e-9);
    farthest.centre_m = std::max(farthest.centre_m,
                                 Norm(at.camera_from_marker.translation_m - truth.translation_m));
    farthest.turn_rad =
        std::max(farthest.turn_rad, RotationAngle(at.camera_from_marker.rotation, truth.rotation));
  }
  return farthest;
}

}  // namespace pleinair::session
