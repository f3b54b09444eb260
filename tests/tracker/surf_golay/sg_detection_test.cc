// Tests S-G markers in single images: detection, identification and pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "base/srgb.h"
#include "tests/tracker/surf_golay/sg_test_scenes.h"

namespace pleinair::tracker {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A typical good lens and sensor.
RenderingOptions Picture(std::uint32_t seed) {
  return {.blur_px = 0.5, .noise_codes = 1.0, .seed = seed};
}

void ExpectOnly(const std::vector<MarkerObservation>& found, int number) {
  ASSERT_EQ(found.size(), 1U) << Summary(found);
  EXPECT_EQ(found[0].detection.family, "sg");
  EXPECT_EQ(found[0].detection.id, number) << Summary(found);
}

TEST(SgDetection, FindsEdgesOf200To16PixelsWithCornersToATenthOfAPixel) {
  const CameraModel camera = SgCamera(360, 330);
  const auto tracker = MakeSgTracker(camera);
  std::uint32_t seed = 1;
  for (const double side_px : {200.0, 120.0, 60.0, 42.0, 30.0, 20.0, 16.0}) {
    for (const int number : {17, 2741}) {
      SCOPED_TRACE(testing::Message() << "edge " << side_px << " px, number " << number);
      const RenderedMarker marker =
          SgMarkerAt(camera, number, {176.3, 161.8}, side_px, 15, 40, 20.0 * seed);
      const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, Picture(seed++)));
      ExpectOnly(found, number);
      if (found.size() != 1) continue;
      EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.1);
      EXPECT_GT(found[0].detection.visible_fraction, 0.85);
    }
  }
}

TEST(SgDetection, MeasuresThroughNoiseAsLargeAsThePrintsContrast) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  double squares = 0.0;
  constexpr int kPictures = 4;
  for (std::uint32_t seed = 1; seed <= kPictures; ++seed) {
    SCOPED_TRACE(seed);
    const RenderedMarker marker = SgMarkerAt(camera, 2000, {161, 118}, 80, 20, 30.0 * seed, 15);
    const auto found =
        Track(tracker.get(),
              RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 75.0, .seed = seed}));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].detection.id, 2000);
    const double rms = CornerRms(found[0], TrueCorners(camera, marker));
    squares += rms * rms;
  }
  EXPECT_LT(std::sqrt(squares / kPictures), 0.5);
}

/// Photon noise and readout noise: variance 0.0288 at white, 0.0023 at black.
void AddPhotonNoise(std::uint32_t seed, GreyImage* image) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      const double light = LinearFromSrgb((*image)(x, y) / 255.0);
      (*image)(x, y) = Srgb8FromLinear(light + std::sqrt(0.0288 * light + 0.0023) * normal(random));
    }
  }
}

// A pixel's own code tells more of its noise than of its light: weighed by it, dark noise counts a
// hundred times as much as bright noise, and corners were off by 0.20 px RMS here.
TEST(SgDetection, MeasuresThroughPhotonNoise) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  double squares = 0.0;
  constexpr int kPictures = 6;
  for (std::uint32_t seed = 1; seed <= kPictures; ++seed) {
    const RenderedMarker marker = SgMarkerAt(camera, 2000, {161, 118}, 80, 20, 30.0 * seed, 15);
    GreyImage image = RenderMarkers(camera, {marker}, {.blur_px = 0.5});
    AddPhotonNoise(seed, &image);
    const auto found = Track(tracker.get(), image);
    ASSERT_EQ(found.size(), 1U) << "seed " << seed;
    const double rms = CornerRms(found[0], TrueCorners(camera, marker));
    squares += rms * rms;
  }
  EXPECT_LT(std::sqrt(squares / kPictures), 0.16);
}

TEST(SgDetection, FindsTiltsTo75Degrees) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  std::uint32_t seed = 1;
  for (const double tilt_deg : {0.0, 40.0, 60.0, 75.0}) {
    for (const double axis_deg : {10.0, 130.0}) {
      SCOPED_TRACE(testing::Message() << tilt_deg << "° about an axis at " << axis_deg << "°");
      const RenderedMarker marker =
          SgMarkerAt(camera, 1234, {158, 121}, 130, tilt_deg, axis_deg, 5);
      const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, Picture(seed++)));
      ExpectOnly(found, 1234);
      if (found.size() == 1) {
        EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.1);
      }
    }
  }
}

TEST(SgDetection, TellsTheRotationAndTheTranslation) {
  CameraModel camera = SgCamera();
  const auto straight = MakeSgTracker(camera, {.strategy = SgStrategy::kFast});
  camera.distortion = {-0.12, 0.04, 0.001, -0.0005, 0, 0, 0, 0};
  const auto bent = MakeSgTracker(camera, {.strategy = SgStrategy::kFast});
  for (Tracker* const tracker : {straight.get(), bent.get()}) {
    CameraModel its = SgCamera();
    if (tracker == bent.get()) its.distortion = camera.distortion;
    // Every quarter turn: up on the marker must be up in the pose.
    for (const double roll_deg : {10.0, 100.0, 190.0, 280.0}) {
      SCOPED_TRACE(testing::Message() << "roll " << roll_deg);
      const RenderedMarker marker = SgMarkerAt(its, 99, {120, 100}, 110, 35, 60, roll_deg);
      const auto found = Track(tracker, RenderMarkers(its, {marker}, Picture(3)));
      ExpectOnly(found, 99);
      if (found.size() != 1) continue;
      EXPECT_LT(CornerRms(found[0], TrueCorners(its, marker)), 0.1);
      const Transform<Camera, Marker>& truth = marker.camera_from_marker;
      const Transform<Camera, Marker>& pose = found[0].pose.best.camera_from_marker;
      EXPECT_LT(RotationApart_deg(pose.rotation, truth.rotation), 0.3);
      EXPECT_LT(Norm(pose.translation_m - truth.translation_m), 1e-3 * Norm(truth.translation_m));
    }
  }
}

TEST(SgDetection, TellsTenMarkersInViewApart) {
  const CameraModel camera = SgCamera(640, 480, 600);
  std::vector<RenderedMarker> markers(10);
  for (int i = 0; i < 10; ++i) {
    const int column = i % 5, row = i / 5;
    markers[i] = SgMarkerAt(camera, 400 * i + 7, {70.0 + 125 * column, 130.0 + 200 * row}, 74,
                            8 * (i % 4), 37 * i, 53 * i);
  }
  const auto found = Track(MakeSgTracker(camera).get(), RenderMarkers(camera, markers, Picture(4)));
  ASSERT_EQ(found.size(), 10U) << Summary(found);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(found[i].detection.id, 400 * i + 7);
    EXPECT_LT(CornerRms(found[i], TrueCorners(camera, markers[i])), 0.1);
  }
}

TEST(SgDetection, FindsFortyMarkersByTheirBordersAlone) {
  // Together they have several times the maximum number of described keypoints.
  const CameraModel camera = SgCamera(640, 480, 600);
  std::vector<RenderedMarker> markers(40);
  for (int i = 0; i < 40; ++i) {
    markers[i] = SgMarkerAt(camera, 100 * i + 7, {48.0 + 77 * (i % 8), 58.0 + 90 * (i / 8)}, 50,
                            8 * (i % 4), 37 * i, 53 * i);
  }
  const auto tracker = MakeSgTracker(camera, {.strategy = SgStrategy::kSurfGolay});
  const auto found = Track(tracker.get(), RenderMarkers(camera, markers, Picture(4)));
  EXPECT_EQ(found.size(), 40U) << Summary(found);
}

TEST(SgDetection, GivesANumberThatIsPrintedTwiceTwice) {
  const CameraModel camera = SgCamera();
  const std::vector<RenderedMarker> markers{SgMarkerAt(camera, 5, {240, 110}, 70, 20, 0, 10),
                                            SgMarkerAt(camera, 5, {90, 120}, 60, 30, 90, 200)};
  const auto found = Track(MakeSgTracker(camera).get(), RenderMarkers(camera, markers, Picture(5)));
  ASSERT_EQ(found.size(), 2U) << Summary(found);
  EXPECT_LT(
      CornerRms(found[0],
                TrueCorners(camera, markers[found[0].detection.corners_px[0].x > 165 ? 0 : 1])),
      0.1);
  EXPECT_LT(found[0].detection.corners_px[0].x, found[1].detection.corners_px[0].x);
  EXPECT_EQ(found[0].detection.id, 5);
  EXPECT_EQ(found[1].detection.id, 5);
}

TEST(SgDetection, DoesNotReportANumberThatIsNotInUse) {
  const CameraModel camera = SgCamera();
  const std::vector<RenderedMarker> markers{SgMarkerAt(camera, 17, {80, 110}, 80, 20, 0, 10),
                                            SgMarkerAt(camera, 3000, {230, 120}, 80, 30, 90, 100)};
  const GreyImage image = RenderMarkers(camera, markers, Picture(6));
  std::vector<int> in_use(50);
  std::iota(in_use.begin(), in_use.end(), 0);
  ExpectOnly(Track(MakeSgTracker(camera, {.numbers_in_use = in_use}).get(), image), 17);
  ExpectOnly(Track(MakeSgTracker(camera, {.numbers_in_use = {3000}}).get(), image), 3000);
  const auto none = Track(MakeSgTracker(camera, {.numbers_in_use = {18}}).get(), image);
  EXPECT_TRUE(none.empty()) << Summary(none);
}

TEST(SgDetection, RefusesNumbersThatDoNotExist) {
  for (const int number : {-1, 4096}) {
    const auto tracker = Tracker::Create(
        SgCamera(),
        {.families = {"sg"}, .marker_size_m = 0.1, .sg = {.numbers_in_use = {17, number}}});
    ASSERT_FALSE(tracker.has_value());
    EXPECT_THAT(tracker.error().Message(), HasSubstr(std::to_string(number)));
    EXPECT_THAT(tracker.error().Message(), HasSubstr("4095"));
  }
}

TEST(SgDetection, RefusesAMirroredPrintAndSaysSo) {
  const CameraModel camera = SgCamera();
  RenderedMarker marker = SgMarkerAt(camera, 321, {150, 120}, 110, 20, 70, 30);
  MarkerPattern mirrored = *marker.pattern;
  for (int row = 0; row < mirrored.modules; ++row) {
    std::reverse(mirrored.white.begin() + row * mirrored.modules,
                 mirrored.white.begin() + (row + 1) * mirrored.modules);
  }
  const auto tracker = MakeSgTracker(camera);
  const GreyImage right_way_round = RenderMarkers(camera, {marker}, Picture(7));
  marker.pattern = std::make_shared<MarkerPattern>(mirrored);
  const auto found = Track(tracker.get(), RenderMarkers(camera, {marker}, Picture(7)));
  EXPECT_TRUE(found.empty()) << Summary(found);
  ASSERT_EQ(tracker->Warnings().size(), 1U);
  EXPECT_THAT(tracker->Warnings()[0], HasSubstr("mirror"));
  EXPECT_THAT(tracker->Warnings()[0], HasSubstr("321"));
  // The warning applies to one image only.
  ExpectOnly(Track(tracker.get(), right_way_round), 321);
  EXPECT_THAT(tracker->Warnings(), IsEmpty());
}

TEST(SgDetection, GivesTheSameBytesForTheSamePictures) {
  const CameraModel camera = SgCamera();
  const std::vector<GreyImage> images{
      RenderMarkers(camera, {SgMarkerAt(camera, 9, {90, 100}, 80, 50, 0, 20)}, Picture(8)),
      RenderMarkers(camera, {SgMarkerAt(camera, 10, {200, 130}, 26, 20, 0, 20)}, Picture(9))};
  for (const bool consecutive : {false, true}) {
    const auto one = MakeSgTracker(camera, {.consecutive_frames = consecutive});
    const auto other = MakeSgTracker(camera, {.consecutive_frames = consecutive});
    for (const GreyImage& image : images) {
      const auto first = Track(one.get(), image), second = Track(other.get(), image);
      ASSERT_EQ(first.size(), second.size());
      EXPECT_FALSE(first.empty());
      for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].detection.id, second[i].detection.id);
        EXPECT_EQ(first[i].detection.corners_px, second[i].detection.corners_px);
        EXPECT_EQ(first[i].detection.visibility, second[i].detection.visibility);
        EXPECT_EQ(first[i].pose.covariance, second[i].pose.covariance);
        EXPECT_EQ(first[i].pose.best.camera_from_marker.rotation,
                  second[i].pose.best.camera_from_marker.rotation);
        EXPECT_EQ(first[i].pose.best.camera_from_marker.translation_m,
                  second[i].pose.best.camera_from_marker.translation_m);
      }
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker
