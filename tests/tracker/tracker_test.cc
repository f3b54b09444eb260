#include "tracker/tracker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/tracker/marker_rendering.h"
#include "tracker/april_tag_detector.h"
#include "tracker/parallel_trackers.h"

namespace pleinair::tracker {
namespace {

using testing::HasSubstr;

CameraModel Camera320() {
  return {.width = 320,
          .height = 200,
          .fx = 400,
          .fy = 400,
          .cx = 161,
          .cy = 98,
          .distortion = {-0.12, 0.04, 0.001, -0.0005, 0, 0, 0, 0}};
}

RenderedMarker MarkerAt(const CameraModel& camera, int id, Vec2 centre_px, double side_px) {
  RenderedMarker marker;
  marker.pattern = AprilTagPattern("tag36h11", id);
  marker.camera_from_marker = PoseAtPixel(camera, centre_px, side_px, marker.size, FromDegrees(35),
                                          FromDegrees(60), FromDegrees(20));
  return marker;
}

std::unique_ptr<Tracker> MakeTracker(const CameraModel& camera) {
  return *Tracker::Create(camera, {.marker_size_m = 0.1});
}

double RotationError_deg(const Mat3& a, const Mat3& b) {
  const Mat3 difference = a * b.Transposed();
  const double sine =
      0.5 * Norm(Vec3{difference(2, 1) - difference(1, 2), difference(0, 2) - difference(2, 0),
                      difference(1, 0) - difference(0, 1)});
  return ToDegrees(Radians(std::asin(std::min(1.0, sine))));
}

TEST(Tracker, GivesThePosesOfTwoMarkersInOrderOfTheirNumbers) {
  const CameraModel camera = Camera320();
  const std::vector<RenderedMarker> markers{MarkerAt(camera, 9, {80, 100}, 80),
                                            MarkerAt(camera, 4, {230, 95}, 70)};
  const auto observations = MakeTracker(camera)->Track(RenderMarkers(camera, markers, {}).view());
  ASSERT_TRUE(observations.has_value());
  ASSERT_EQ(observations->size(), 2U);
  for (int i = 0; i < 2; ++i) {
    const RenderedMarker& marker = markers[1 - i];
    const MarkerObservation& observation = (*observations)[i];
    EXPECT_EQ(observation.detection.id, i == 0 ? 4 : 9);
    EXPECT_EQ(observation.detection.family, "tag36h11");
    EXPECT_GT(observation.detection.visible_fraction, 0.95);
    EXPECT_STREQ(TrajectoryName(observation.detection.path), "fast");
    const auto& pose = observation.pose.best.camera_from_marker;
    EXPECT_LT(Norm(pose.translation_m - marker.camera_from_marker.translation_m),
              3e-4 * Norm(marker.camera_from_marker.translation_m));
    EXPECT_LT(RotationError_deg(pose.rotation, marker.camera_from_marker.rotation), 0.03);
    const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
    for (int corner = 0; corner < 4; ++corner) {
      EXPECT_LT(Norm(observation.detection.corners_px[corner] - truth[corner]), 0.05);
    }
  }
}

TEST(Tracker, MeasuresATagOfWhichThePicturesEdgeCutsACornerOff) {
  // The tag leaves the image downwards; its lowest corner is up to a module below the image.
  const CameraModel camera = Camera320();
  int cut_off = 0, found = 0;
  for (int step = 0; step < 160; ++step) {
    const RenderedMarker marker = MarkerAt(camera, 3, {150, 120.0 + 0.5 * step}, 80);
    const std::array<Vec2, 4> truth = TrueCorners(camera, marker);
    const double lowest_px =
        std::max({truth[0].y, truth[1].y, truth[2].y, truth[3].y}) - (camera.height - 1);
    if (lowest_px < 0.0 || lowest_px > 9.0) continue;
    ++cut_off;
    const auto observations = MakeTracker(camera)->Track(
        RenderMarkers(camera, {marker}, {.blur_px = 0.4, .noise_codes = 2}).view());
    ASSERT_TRUE(observations.has_value());
    if (observations->empty()) continue;
    ++found;
    for (int corner = 0; corner < 4; ++corner) {
      EXPECT_LT(Norm((*observations)[0].detection.corners_px[corner] - truth[corner]), 0.3)
          << "corner " << corner << ", " << lowest_px << " pixels cut off";
    }
  }
  EXPECT_GE(cut_off, 8);
  EXPECT_GE(found, cut_off * 3 / 4);
}

TEST(Tracker, GivesTheSameBytesForTheSamePicture) {
  const CameraModel camera = Camera320();
  const GreyImage image =
      RenderMarkers(camera, {MarkerAt(camera, 1, {90, 90}, 60), MarkerAt(camera, 1, {220, 90}, 60)},
                    {.noise_codes = 4.0, .light = {}});
  const auto tracker = MakeTracker(camera);
  const auto first = tracker->Track(image.view());
  ASSERT_EQ(first->size(), 2U);
  EXPECT_LT((*first)[0].detection.corners_px[0].x, (*first)[1].detection.corners_px[0].x);
  for (const auto& again :
       {tracker->Track(image.view()), MakeTracker(camera)->Track(image.view())}) {
    ASSERT_EQ(again->size(), first->size());
    for (std::size_t i = 0; i < first->size(); ++i) {
      EXPECT_EQ((*again)[i].detection.corners_px, (*first)[i].detection.corners_px);
      EXPECT_EQ((*again)[i].pose.covariance, (*first)[i].pose.covariance);
      EXPECT_EQ((*again)[i].pose.best.camera_from_marker.rotation,
                (*first)[i].pose.best.camera_from_marker.rotation);
    }
  }
}

TEST(ParallelTrackers, GiveTheMarkersOfASingleTrackerInTheOrderOfTheImages) {
  const CameraModel camera = Camera320();
  std::vector<GreyImage> images;
  for (int id = 1; id <= 5; ++id) {
    images.push_back(RenderMarkers(camera, {MarkerAt(camera, id, {60.0 + 30.0 * id, 90}, 60)},
                                   {.noise_codes = 4.0, .light = {}}));
  }
  std::vector<ImageView<const std::uint8_t>> views;
  for (const GreyImage& image : images) views.push_back(image.view());
  auto parallel = ParallelTrackers::Create(camera, {.marker_size_m = 0.1}, 3);
  ASSERT_TRUE(parallel);
  const auto together = parallel->Track(views);
  const auto found = parallel->Find(views);
  ASSERT_TRUE(together && found);
  ASSERT_EQ(together->size(), images.size());
  ASSERT_EQ(found->size(), images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const auto alone = MakeTracker(camera)->Track(views[i]);
    ASSERT_EQ(alone->size(), 1U) << i;
    ASSERT_EQ((*together)[i].size(), 1U) << i;
    EXPECT_EQ((*together)[i][0].detection.id, static_cast<int>(i) + 1);
    EXPECT_EQ((*together)[i][0].detection.corners_px, (*alone)[0].detection.corners_px);
    EXPECT_EQ((*together)[i][0].pose.covariance, (*alone)[0].pose.covariance);
    ASSERT_EQ((*found)[i].candidates.size(), 1U) << i;
    EXPECT_EQ((*found)[i].candidates[0].detection.id, static_cast<int>(i) + 1);
  }
}

TEST(ParallelTrackers, TellTheErrorOfAnImageOfAnotherSize) {
  const CameraModel camera = Camera320();
  auto parallel = ParallelTrackers::Create(camera, {.marker_size_m = 0.1}, 3);
  ASSERT_TRUE(parallel);
  const GreyImage good(320, 200), other(64, 64);
  const auto tracked = parallel->Track(std::vector{good.view(), other.view(), good.view()});
  ASSERT_FALSE(tracked);
  EXPECT_THAT(tracked.error().Message(), HasSubstr("64x64"));
}

TEST(Tracker, FindsNothingInABlankPicture) {
  const CameraModel camera = Camera320();
  const auto observations = MakeTracker(camera)->Track(GreyImage(320, 200).view());
  ASSERT_TRUE(observations.has_value());
  EXPECT_TRUE(observations->empty());
}

TEST(Tracker, TakesAPictureOfOnePixel) {
  const CameraModel camera{.width = 1, .height = 1, .fx = 1, .fy = 1};
  const auto observations = MakeTracker(camera)->Track(GreyImage(1, 1).view());
  ASSERT_TRUE(observations.has_value());
  EXPECT_TRUE(observations->empty());
}

TEST(Tracker, RefusesAnImageOfAnotherSizeThanItsCamera) {
  const auto observations = MakeTracker(Camera320())->Track(GreyImage(640, 480).view());
  ASSERT_FALSE(observations.has_value());
  EXPECT_THAT(observations.error().Message(), HasSubstr("640x480"));
  EXPECT_THAT(observations.error().Message(), HasSubstr("320x200"));
  EXPECT_FALSE(MakeTracker(Camera320())->Track({}).has_value());
}

TEST(Tracker, RefusesOptionsThatCannotBeMeant) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double size_m : {0.0, -0.1, nan, 1e-9, 1e9}) {
    EXPECT_FALSE(Tracker::Create(Camera320(), {.marker_size_m = size_m}).has_value());
  }
  EXPECT_FALSE(Tracker::Create(Camera320(), {.families = {}, .marker_size_m = 0.1}).has_value());
  EXPECT_FALSE(
      Tracker::Create(Camera320(), {.families = {"qr"}, .marker_size_m = 0.1}).has_value());
  CameraModel camera = Camera320();
  camera.fx = 0.0;
  EXPECT_FALSE(Tracker::Create(camera, {.marker_size_m = 0.1}).has_value());
  camera.fx = nan;
  EXPECT_FALSE(Tracker::Create(camera, {.marker_size_m = 0.1}).has_value());
  camera = Camera320();
  camera.distortion[2] = nan;
  EXPECT_FALSE(Tracker::Create(camera, {.marker_size_m = 0.1}).has_value());
}

}  // namespace
}  // namespace pleinair::tracker
