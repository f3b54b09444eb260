#include "tests/tracker/surf_golay/sg_test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tracker/golay/golay_code.h"
#include "tracker/surf_golay/sg_layout.h"
#include "tracker/surf_golay/sg_marker_pattern.h"

namespace pleinair::tracker {

CameraModel SgCamera(int width, int height, double focal_px) {
  return {.width = width,
          .height = height,
          .fx = focal_px,
          .fy = focal_px,
          .cx = 0.5 * (width - 1),
          .cy = 0.5 * (height - 1)};
}

RenderedMarker SgMarkerAt(const CameraModel& camera, int number, Vec2 centre_px, double side_px,
                          double tilt_deg, double axis_deg, double roll_deg) {
  RenderedMarker marker;
  marker.pattern = std::make_shared<MarkerPattern>(SgMarkerPattern(number));
  marker.camera_from_marker =
      PoseAtPixel(camera, centre_px, side_px, marker.size, FromDegrees(tilt_deg),
                  FromDegrees(axis_deg), FromDegrees(roll_deg));
  return marker;
}

std::unique_ptr<Tracker> MakeSgTracker(const CameraModel& camera, const SgTrackerOptions& options) {
  auto tracker = Tracker::Create(
      camera, {.families = {"sg"},
               .marker_size_m = RenderedMarker().size.value(),
               .consecutive_frames = options.consecutive_frames,
               .sg = {.strategy = options.strategy, .numbers_in_use = options.numbers_in_use}});
  EXPECT_TRUE(tracker.has_value()) << tracker.error().Message();
  return std::move(*tracker);
}

std::vector<MarkerObservation> Track(Tracker* tracker, const GreyImage& image) {
  auto observations = tracker->Track(image.view());
  EXPECT_TRUE(observations.has_value()) << observations.error().Message();
  return observations ? *std::move(observations) : std::vector<MarkerObservation>();
}

double CornerRms(const MarkerObservation& observation, const std::array<Vec2, 4>& truth) {
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double distance_px = Norm(observation.detection.corners_px[i] - truth[i]);
    sum += 0.25 * distance_px * distance_px;
  }
  return std::sqrt(sum);
}

double RotationApart_deg(const Mat3& a, const Mat3& b) {
  // The chord is precise where the cosine is not; exact for all angles to 180°.
  double square = 0.0;
  for (int i = 0; i < 9; ++i) square += (a.m[i] - b.m[i]) * (a.m[i] - b.m[i]);
  return ToDegrees(Radians(2.0 * std::asin(std::min(1.0, std::sqrt(square / 8.0)))));
}

std::string Summary(const std::vector<MarkerObservation>& observations) {
  std::string text;
  for (const MarkerObservation& observation : observations) {
    text += (text.empty() ? "" : ", ") +
            (observation.detection.id ? std::to_string(*observation.detection.id) : "no number") +
            " " + TrajectoryName(observation.detection.path) + " at " +
            std::to_string(std::lround(observation.detection.corners_px[0].x)) + "," +
            std::to_string(std::lround(observation.detection.corners_px[0].y)) + " " +
            std::to_string(std::lround(100.0 * observation.detection.visible_fraction)) + " %";
  }
  return "[" + text + "]";
}

bool IsWhite(int number, int cell) { return (CodewordOfNumber(number) >> cell & 1U) != 0; }

Vec2 ModulesOf(Vec2 at) { return {0.5 * sg::kEdge * (1.0 + at.x), 0.5 * sg::kEdge * (1.0 - at.y)}; }

}  // namespace pleinair::tracker
