// Tests tracking of targets over consecutive frames, and its memory use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/tracker/counted_memory.h"
#include "tests/tracker/picture_target/picture_target_scenes.h"
#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/picture_target/picture_detector.h"
#include "tracker/picture_target/target_making.h"

namespace pleinair::tracker {
namespace {

using testing::IsEmpty;

struct Subject {
  TestPicture picture;
  std::shared_ptr<const PictureTarget> target;
};

const Subject& Leaves() {
  static const Subject kSubject = [] {
    TestPicture picture = DeadLeaves(3, 640, 480);
    auto target = MakePictureTarget(picture.Codes().view(), Metres(0.4), "leaves");
    EXPECT_TRUE(target.has_value()) << target.error().Message();
    return Subject{std::move(picture), std::make_shared<const PictureTarget>(*std::move(target))};
  }();
  return kSubject;
}

CameraModel Camera() { return SgCamera(320, 240, 400); }

enum class Covered { kNothing, kHalf, kAll };

/// A hand-held camera that moves past the target.
HungPicture Hung(int frame, Covered covered = Covered::kNothing) {
  HungPicture hung = HangAt(Camera(), Leaves().picture, {130.0 + 4.0 * frame, 110.0 + 2.5 * frame},
                            140.0 + 1.5 * frame, 25.0 + frame, 40.0, 10.0 + 1.2 * frame);
  if (covered != Covered::kNothing) {
    hung.cover = [=](Vec2 at) {
      return covered == Covered::kAll || at.x < 0.5 ? 0.3 + 0.1 * std::sin(25.0 * at.y) : -1.0;
    };
  }
  return hung;
}

GreyImage Frame(int frame, Covered covered = Covered::kNothing) {
  return RenderPictures(Camera(), {Hung(frame, covered)},
                        {.blur_px = 0.6, .noise_codes = 1.5, .seed = 1U + frame});
}

class PictureTracking : public testing::Test {
 protected:
  void SetUp() override {
    auto tracker = Tracker::Create(
        Camera(), {.families = {}, .consecutive_frames = true, .targets = {Leaves().target}});
    ASSERT_TRUE(tracker.has_value()) << tracker.error().Message();
    tracker_ = *std::move(tracker);
  }

  void ExpectImage(int frame, Covered covered, DetectionPath path, double corner_px = 0.1) {
    SCOPED_TRACE(testing::Message() << "frame " << frame);
    const auto found = Track(tracker_.get(), Frame(frame, covered));
    ASSERT_EQ(found.size(), 1U) << Summary(found);
    EXPECT_EQ(found[0].detection.name, "leaves");
    EXPECT_STREQ(TrajectoryName(found[0].detection.path), TrajectoryName(path));
    EXPECT_LT(CornerRms(found[0], TrueCorners(Camera(), Hung(frame))), corner_px);
    EXPECT_THAT(tracker_->Lost(), IsEmpty());
  }

  void ExpectLost(const GreyImage& picture, int since) {
    const auto found = Track(tracker_.get(), picture);
    EXPECT_THAT(found, IsEmpty()) << Summary(found);
    const auto lost = tracker_->Lost();
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].family, "picture");
    EXPECT_EQ(lost[0].name, "leaves");
    EXPECT_EQ(lost[0].id, 0);
    EXPECT_EQ(lost[0].frames, since);
  }

  std::unique_ptr<Tracker> tracker_;
};

TEST_F(PictureTracking, FollowsAPictureWhileAHandPassesOverIt) {
  ExpectImage(0, Covered::kNothing, DetectionPath::kSurfGolay);
  for (int frame = 1; frame < 6; ++frame) {
    ExpectImage(frame, Covered::kNothing, DetectionPath::kTracked);
  }
  for (int frame = 6; frame < 10; ++frame) {
    ExpectImage(frame, Covered::kHalf, DetectionPath::kTracked, 0.3);
  }
  ExpectImage(10, Covered::kNothing, DetectionPath::kTracked);
}

TEST_F(PictureTracking, SaysSinceWhenAPictureIsLostAndFindsItAgain) {
  EXPECT_THAT(Track(tracker_.get(), GreyImage(320, 240)), IsEmpty());
  EXPECT_THAT(tracker_->Lost(), IsEmpty());  // A target that was never observed is not lost.
  Track(tracker_.get(), GreyImage(320, 240));
  Track(tracker_.get(), GreyImage(320, 240));
  ExpectImage(0, Covered::kNothing, DetectionPath::kSurfGolay);
  ExpectImage(1, Covered::kNothing, DetectionPath::kTracked);
  ExpectLost(Frame(2, Covered::kAll), 1);
  ExpectLost(Frame(3, Covered::kAll), 2);
  ExpectLost(DeadLeaves(77, 320, 240).Codes(), 3);
  // Far from its last position.
  ExpectImage(20, Covered::kNothing, DetectionPath::kSurfGolay);
  ExpectImage(21, Covered::kNothing, DetectionPath::kTracked);
}

TEST_F(PictureTracking, HoldsTheSameMemoryAfterManyFrames) {
  std::vector<GreyImage> frames;
  for (int i = 0; i < 6; ++i)
    frames.push_back(Frame(i, i == 4 ? Covered::kAll : Covered::kNothing));
  const auto go_round = [&](int times) {
    for (int i = 0; i < times; ++i) {
      for (const GreyImage& frame : frames) EXPECT_TRUE(tracker_->Track(frame.view()).has_value());
    }
  };
  go_round(4);
  const long before = LiveBytes();
  go_round(12);
  EXPECT_NEAR(static_cast<double>(LiveBytes()), static_cast<double>(before), 4096.0);
}

TEST(ImageMemory, IsAskedForInAHandfulOfPiecesForAFollowedPicture) {
  PictureDetector detector(Camera(), {Leaves().target}, true);
  const GreyImage frame = Frame(0);
  for (int i = 0; i < 5; ++i) ASSERT_EQ(detector.Detect(frame.view()).size(), 1U);
  const long before = Allocations();
  constexpr int kFrames = 20;
  for (int i = 0; i < kFrames; ++i) ASSERT_EQ(detector.Detect(frame.view()).size(), 1U);
  const double a_frame = static_cast<double>(Allocations() - before) / kFrames;
  RecordProperty("allocations_a_frame", std::to_string(a_frame));
  // The returned list, its visibility map, and usually the pose. No allocation per pixel, block or
  // step.
  EXPECT_LT(a_frame, 150.0);
}

}  // namespace
}  // namespace pleinair::tracker
