// Tests tracking of S-G markers over consecutive frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

using testing::IsEmpty;

/// Covered part of the marker.
enum class Covered { kNothing, kLeftSide, kAll };

GreyImage Frame(const CameraModel& camera, int number, Vec2 centre_px, int frame,
                Covered covered = Covered::kNothing) {
  RenderedMarker marker =
      SgMarkerAt(camera, number, centre_px, 96 + 0.5 * frame, 25, 40, 10 + 0.7 * frame);
  if (covered != Covered::kNothing) {
    marker.cover = [=](Vec2 at) {
      return covered == Covered::kAll || ModulesOf(at).x < 10 ? 0.30 : -1.0;
    };
  }
  return RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = 1U + frame});
}

std::array<Vec2, 4> Truth(const CameraModel& camera, Vec2 centre_px, int frame) {
  return TrueCorners(camera,
                     SgMarkerAt(camera, 0, centre_px, 96 + 0.5 * frame, 25, 40, 10 + 0.7 * frame));
}

class SgTracking : public testing::Test {
 protected:
  /// Passes a frame to the tracker and expects marker 17 with its true corners.
  void ExpectMarker(const GreyImage& image, Vec2 centre_px, int frame,
                    std::optional<DetectionPath> path, double corner_px = 0.1) {
    SCOPED_TRACE(testing::Message() << "frame " << frame);
    const auto found = Track(tracker_.get(), image);
    ASSERT_EQ(found.size(), 1U) << Summary(found);
    EXPECT_EQ(found[0].detection.id, 17);
    if (path) {
      EXPECT_STREQ(TrajectoryName(found[0].detection.path), TrajectoryName(*path));
    }
    EXPECT_LT(CornerRms(found[0], Truth(camera_, centre_px, frame)), corner_px);
    EXPECT_THAT(tracker_->Lost(), IsEmpty());
  }

  void ExpectLost(const GreyImage& image, int since) {
    const auto found = Track(tracker_.get(), image);
    EXPECT_TRUE(found.empty()) << Summary(found);
    const std::vector<LostMarker> lost = tracker_->Lost();
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].family, "sg");
    EXPECT_EQ(lost[0].id, 17);
    EXPECT_EQ(lost[0].frames, since);
  }

  const CameraModel camera_ = SgCamera();
  const std::unique_ptr<Tracker> tracker_ = MakeSgTracker(camera_, {.consecutive_frames = true});
};

TEST_F(SgTracking, SaysHowAMarkerWasFoundAndThenThatItIsTracked) {
  for (int frame = 0; frame < 12; ++frame) {
    const Vec2 centre{130 + 3.0 * frame, 115 + 1.0 * frame};
    ExpectMarker(Frame(camera_, 17, centre, frame), centre, frame,
                 frame == 0 ? DetectionPath::kFast : DetectionPath::kTracked);
  }
}

TEST_F(SgTracking, SaysWhichMarkerIsLostAndSinceWhenUntilItIsBack) {
  int frame = 0;
  for (; frame < 3; ++frame) {
    ExpectMarker(Frame(camera_, 17, {120, 115}, frame), {120, 115}, frame, std::nullopt);
  }
  for (int since = 1; since <= 4; ++since, ++frame) {
    ExpectLost(Frame(camera_, 17, {120, 115}, frame, Covered::kAll), since);
  }
  // Outside the predicted region: by its quadrilateral.
  ExpectMarker(Frame(camera_, 17, {195, 120}, frame), {195, 120}, frame, DetectionPath::kFast);
  ++frame;
  ExpectMarker(Frame(camera_, 17, {195, 120}, frame), {195, 120}, frame, DetectionPath::kTracked);
  ++frame;
  ExpectLost(Frame(camera_, 17, {195, 120}, frame, Covered::kAll), 1);
  ++frame;
  // With a hand still on its border: by its keypoints.
  ExpectMarker(Frame(camera_, 17, {120, 125}, frame, Covered::kLeftSide), {120, 125}, frame,
               DetectionPath::kSurfGolay, 0.5);
  ++frame;
  ExpectMarker(Frame(camera_, 17, {120, 125}, frame, Covered::kLeftSide), {120, 125}, frame,
               DetectionPath::kTracked, 0.5);
}

TEST_F(SgTracking, HoldsAMarkerWhileSomethingMovesOverIt) {
  for (int frame = 0; frame < 14; ++frame) {
    SCOPED_TRACE(testing::Message() << "frame " << frame);
    const Vec2 centre{150 + 1.5 * frame, 118};
    RenderedMarker marker = SgMarkerAt(camera_, 17, centre, 100, 25, 40, 10);
    // A bar a third as wide as the marker crosses it.
    marker.cover = [=](Vec2 at) {
      return std::fabs(at.x + 1.6 - 0.24 * frame) < 0.33 ? 0.30 : -1.0;
    };
    const auto found = Track(
        tracker_.get(),
        RenderMarkers(camera_, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = 1U + frame}));
    ASSERT_EQ(found.size(), 1U) << Summary(found);
    EXPECT_EQ(found[0].detection.id, 17);
    EXPECT_LT(CornerRms(found[0], TrueCorners(camera_, marker)), 0.5);
  }
}

TEST_F(SgTracking, SeesAtOnceThatAnotherNumberHangsInTheSamePlace) {
  // 16, 18 and 3000 differ from 17 in at least eight cells.
  int frame = 0;
  for (const int number : {17, 18, 3000, 16, 17}) {
    for (int i = 0; i < 3; ++i, ++frame) {
      SCOPED_TRACE(testing::Message() << "frame " << frame);
      const auto found = Track(tracker_.get(), Frame(camera_, number, {150, 118}, frame));
      ASSERT_EQ(found.size(), 1U) << Summary(found);
      EXPECT_EQ(found[0].detection.id, number);
    }
  }
}

// The last step of a fit may be 0.06 px, which leaves a fortieth of itself: followed again through
// the same image, from where it was found, a marker stays where it is.
TEST(SgTrackingAgain, FindsAMarkerOfAnySizeWhereItFindsItAgain) {
  const CameraModel camera = SgCamera(160, 150);
  for (const double side_px : {50.0, 58.0, 90.0}) {
    SCOPED_TRACE(testing::Message() << "edge " << side_px << " px");
    const auto tracker = MakeSgTracker(camera, {.consecutive_frames = true});
    const auto image = [&](Vec2 centre_px) {
      const RenderedMarker marker = SgMarkerAt(camera, 17, centre_px, side_px, 25, 40, 10);
      return RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = 41});
    };
    Track(tracker.get(), image({80, 75}));
    const GreyImage moved = image({81.7, 76.1});
    const auto first = Track(tracker.get(), moved);
    ASSERT_EQ(first.size(), 1U) << Summary(first);
    std::vector<MarkerObservation> last;
    for (int frame = 0; frame < 6; ++frame) last = Track(tracker.get(), moved);
    ASSERT_EQ(last.size(), 1U) << Summary(last);
    EXPECT_LT(CornerRms(first[0], last[0].detection.corners_px), 0.003);
  }
}

// From its quadrilateral's corners, tenths of a pixel away, a print is fitted in one or two steps.
// What they leave of a large one must be less than noise moves it by, 0.002 px: a longer step that
// was the last would leave up to ten times as much.
TEST(SgTrackingAgain, FindsALargeMarkerAtOnceWhereItStaysWhenFollowed) {
  const CameraModel camera = SgCamera(280, 260);
  for (const double side_px : {120.0, 170.0}) {
    for (int way = 0; way < 6; ++way) {
      SCOPED_TRACE(testing::Message() << "edge " << side_px << " px, way round " << way);
      const RenderedMarker marker = SgMarkerAt(camera, 17, {142.5 - 0.7 * way, 130.0 + 0.4 * way},
                                               side_px, 25, 40 + 20 * way, 10 + 30 * way);
      const GreyImage image =
          RenderMarkers(camera, {marker}, {.blur_px = 0.5, .noise_codes = 1.0, .seed = 41});
      const auto tracker =
          MakeSgTracker(camera, {.strategy = SgStrategy::kFast, .consecutive_frames = true});
      const auto first = Track(tracker.get(), image);
      ASSERT_EQ(first.size(), 1U) << Summary(first);
      EXPECT_STREQ(TrajectoryName(first[0].detection.path), "fast");
      std::vector<MarkerObservation> last;
      for (int frame = 0; frame < 6; ++frame) last = Track(tracker.get(), image);
      ASSERT_EQ(last.size(), 1U) << Summary(last);
      EXPECT_LT(CornerRms(first[0], last[0].detection.corners_px), 0.002);
    }
  }
}

TEST_F(SgTracking, NeverMistakesAMarkerForItsNeighbour) {
  // Two markers side by side swap places while both are covered.
  for (int frame = 0; frame < 12; ++frame) {
    SCOPED_TRACE(testing::Message() << "frame " << frame);
    const bool changed = frame > 6, covered = frame == 5 || frame == 6;
    std::vector<RenderedMarker> markers{
        SgMarkerAt(camera_, changed ? 900 : 17, {90 + 0.5 * frame, 110}, 80, 15, 40, 5),
        SgMarkerAt(camera_, changed ? 17 : 900, {230 + 0.5 * frame, 120}, 80, 15, 10, 8)};
    if (covered) {
      for (RenderedMarker& marker : markers) marker.cover = [](Vec2) { return 0.3; };
    }
    const auto found = Track(
        tracker_.get(),
        RenderMarkers(camera_, markers, {.blur_px = 0.5, .noise_codes = 1.0, .seed = 1U + frame}));
    ASSERT_EQ(found.size(), covered ? 0U : 2U) << Summary(found);
    EXPECT_EQ(tracker_->Lost().size(), covered ? 2U : 0U);
    if (covered) continue;
    EXPECT_EQ(found[0].detection.id, 17);
    EXPECT_EQ(found[1].detection.id, 900);
    EXPECT_LT(CornerRms(found[0], TrueCorners(camera_, markers[changed ? 1 : 0])), 0.1);
    EXPECT_LT(CornerRms(found[1], TrueCorners(camera_, markers[changed ? 0 : 1])), 0.1);
  }
}

TEST(SgTrackingAgain, FollowsAMarkerThatJumpsToNoPlaceWhereItIsNot) {
  const CameraModel camera = SgCamera();
  // Small and observed from low: a fit that begins beside it may find a part of it elsewhere, as it
  // did after these of sixty jumps.
  for (const int jump : {17, 20, 30, 40, 43, 47}) {
    SCOPED_TRACE(testing::Message() << "jump " << jump);
    const auto tracker = MakeSgTracker(camera, {.consecutive_frames = true});
    const auto track = [&](Vec2 centre, double turn_deg, unsigned seed) {
      const RenderedMarker marker = SgMarkerAt(camera, 17, centre, 62, 58, 0, turn_deg);
      const auto found = Track(
          tracker.get(),
          RenderMarkers(camera, {marker}, {.blur_px = 0.6, .noise_codes = 3.0, .seed = seed}));
      ASSERT_EQ(found.size(), 1U) << Summary(found);
      EXPECT_GT(found[0].detection.visible_fraction, 0.6);
      EXPECT_LT(CornerRms(found[0], TrueCorners(camera, marker)), 0.6);
    };
    track({120, 110}, 10, 1 + jump);
    const double angle = 0.7 * jump, far_px = 2.0 + 0.2 * jump;
    track({120 + far_px * std::cos(angle), 110 + far_px * std::sin(angle)},
          10 + 14 * std::sin(1.3 * jump), 100 + jump);
  }
}

TEST_F(SgTracking, FindsAMarkerThatComesIntoViewBesideAnother) {
  int first_seen = -1;
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<RenderedMarker> markers{SgMarkerAt(camera_, 17, {90, 110}, 80, 15, 40, 5)};
    if (frame >= 4) markers.push_back(SgMarkerAt(camera_, 5, {230, 120}, 80, 15, 10, 8));
    const auto found = Track(
        tracker_.get(),
        RenderMarkers(camera_, markers, {.blur_px = 0.5, .noise_codes = 1.0, .seed = 1U + frame}));
    ASSERT_GE(found.size(), 1U);
    EXPECT_EQ(found.back().detection.id, 17);
    if (found.size() == 2 && first_seen < 0) first_seen = frame;
    if (first_seen >= 0) {
      EXPECT_EQ(found.size(), 2U);
    }
  }
  EXPECT_GE(first_seen, 4);
  EXPECT_LE(first_seen, 10);
}

TEST_F(SgTracking, ForgetsWithTimeAMarkerThatDoesNotComeBack) {
  ExpectMarker(Frame(camera_, 17, {120, 115}, 0), {120, 115}, 0, std::nullopt);
  const GreyImage empty = RenderMarkers(camera_, {}, {});
  int listed = 0;
  for (int frame = 1; frame <= 400 && (frame == 1 || !tracker_->Lost().empty()); ++frame) {
    EXPECT_THAT(Track(tracker_.get(), empty), IsEmpty());
    listed = frame;
  }
  EXPECT_GE(listed, 15);
  EXPECT_LT(listed, 400);
}

TEST(SgSinglePictures, KnowNothingOfThePictureBefore) {
  const CameraModel camera = SgCamera();
  const auto tracker = MakeSgTracker(camera);
  EXPECT_EQ(Track(tracker.get(), Frame(camera, 17, {120, 115}, 0)).size(), 1U);
  EXPECT_THAT(Track(tracker.get(), Frame(camera, 17, {120, 115}, 0, Covered::kAll)), IsEmpty());
  EXPECT_THAT(tracker->Lost(), IsEmpty());
}

}  // namespace
}  // namespace pleinair::tracker
