#include "compositor/photometry/changes/light_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/compositor/photometry/changes/clouded_yard.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::compositor {
namespace {

using testing::CloudedFilm;
using testing::CoverTheMarker;
using testing::ErrorsOf;
using testing::FilmAt30Hz;
using testing::FilmYard;
using testing::HideSunlitProbes;
using testing::LightErrors;
using testing::Moment;
using testing::MoveOn;
using testing::PhotographedYard;
using testing::UnderACloud;
using testing::UnderLamps;
using testing::WalkThroughTheSun;
using testing::Yard;

constexpr int kFrames = testing::kYardFrames;

/// Films the yard and fits its light. The first two frames are the reference.
LightChanges Follow(const std::function<Moment(int)>& moment,
                    const PhotographedYard::Light& light = {},
                    const std::function<void(int, RgbImage*)>& disturb = {},
                    std::size_t max_readings = 100'000) {
  const LightProbes probes = FilmYard(moment, light, disturb, max_readings);
  std::size_t readings = 0;
  for (const ProbedFrame& frame : probes.frames()) readings += frame.probes.size();
  EXPECT_LE(readings, max_readings);
  const auto lights =
      LightOn(probes.probes(), Yard().phantoms(), Yard().model(), Yard().marker_from_world());
  return FitLightChanges(probes.frames(), probes.probes(), lights, {0, 1});
}

/// The same for changed readings of a film.
LightChanges FollowSpoiled(const LightProbes& probes,
                           const std::function<void(std::vector<ProbedFrame>*)>& spoil,
                           const std::vector<std::size_t>& reference = {0, 1}) {
  const auto lights =
      LightOn(probes.probes(), Yard().phantoms(), Yard().model(), Yard().marker_from_world());
  auto frames = probes.frames();
  spoil(&frames);
  return FitLightChanges(frames, probes.probes(), lights, reference);
}

void ExpectFollowed(const LightChanges& found, const std::function<Moment(int)>& moment) {
  const LightErrors errors = ErrorsOf(found.frames, moment);
  EXPECT_TRUE(found.changes);
  EXPECT_LE(errors.sun_rms, 0.05);
  EXPECT_LE(errors.sky_rms, 0.04);
  EXPECT_LE(errors.largest, 0.15);
  for (int frame = 0; frame < kFrames; ++frame) {
    const Moment now = moment(frame);
    const double off = found.frames[frame].LogRatio() - std::log(now.sun / now.sky);
    EXPECT_LE(std::fabs(off), 4 * found.frames[frame].log_ratio_error) << frame;
  }
}

TEST(LightChanges, FollowACloud) {
  const LightChanges found = Follow(UnderACloud);
  ExpectFollowed(found, UnderACloud);
  for (const FrameLight& frame : found.frames) {
    EXPECT_EQ(frame.source, FrameLight::Source::kSurfaces);
  }
}

TEST(LightChanges, FollowACloudByAPartOfTheReadings) {
  ExpectFollowed(Follow(UnderACloud, {}, {}, 3000), UnderACloud);
}

TEST(LightChanges, FollowACloudWhoseReferenceFramesAreNearlyCovered) {
  // Of one reference frame three readings are left, all wrong: they say nothing of the others.
  const auto cover = [](std::vector<ProbedFrame>* frames) {
    ProbedFrame& first = frames->front();
    first.probes.resize(3);
    first.linear.assign(3, {0.01F, 0.01F, 0.01F});
  };
  const LightChanges found = FollowSpoiled(CloudedFilm(), cover);
  EXPECT_TRUE(found.changes);
  for (const int frame : {1, 8, 16}) {
    const Moment now = UnderACloud(frame);
    EXPECT_NEAR(MeanLog(found.frames[frame].sun), std::log(now.sun), 0.1) << frame;
    EXPECT_NEAR(MeanLog(found.frames[frame].sky), std::log(now.sky), 0.05) << frame;
  }
}

TEST(LightChanges, FollowACloudOverACameraThatMovesOn) {
  const LightChanges found = FollowSpoiled(CloudedFilm(), MoveOn);
  EXPECT_LE(ErrorsOf(found.frames, UnderACloud).largest, 0.3);
  double off = 0.0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Moment now = UnderACloud(frame);
    off = found.frames[frame].LogRatio() - std::log(now.sun / now.sky);
  }
  RecordProperty("ratio_off", std::to_string(off));
  RecordProperty("ratio_error", std::to_string(found.frames.back().log_ratio_error));
  // Errors add up from surface to surface.
  const LightChanges unmoved = Follow(UnderACloud);
  EXPECT_GE(found.frames.back().log_ratio_error, 2 * unmoved.frames.back().log_ratio_error);
  EXPECT_FALSE(FollowSpoiled(FilmYard([](int) { return Moment{}; }), MoveOn).changes);
}

TEST(LightChanges, FollowACloudThatTheExposureFollows) {
  const auto moment = [](int frame) {
    Moment now = UnderACloud(frame);
    now.exposure = 1.0 / (0.5 * now.sun + 0.5);
    return now;
  };
  ExpectFollowed(Follow(moment), moment);
}

TEST(LightChanges, FollowACloudWhileTheExposureJumps) {
  const auto moment = [](int frame) {
    Moment now = UnderACloud(frame);
    if (frame >= 7) now.exposure = 1.4;
    return now;
  };
  ExpectFollowed(Follow(moment), moment);
}

TEST(LightChanges, FollowACloudWhileAPersonHidesAThirdOfTheSunlitProbes) {
  ExpectFollowed(FollowSpoiled(CloudedFilm(), HideSunlitProbes), UnderACloud);
}

TEST(LightChanges, FollowACloudThatComesWithAHandOverTheMarker) {
  ExpectFollowed(FollowSpoiled(CloudedFilm(), CoverTheMarker), UnderACloud);
}

TEST(LightChanges, TakeLampsThatFlickerForExposure) {
  const auto moment = [](int frame) { return Moment{1.0, 1.0, UnderLamps(frame)}; };
  const LightChanges found = FollowSpoiled(FilmYard(moment), FilmAt30Hz);
  EXPECT_FALSE(found.changes);
  // The mean of the two reference frames has the exposure 1.
  const double mean = (std::log(UnderLamps(0)) + std::log(UnderLamps(1))) / 2;
  for (const FrameLight& frame : found.frames) {
    const double exposure = std::log(UnderLamps(static_cast<int>(frame.frame_index))) - mean;
    EXPECT_NEAR(MeanLog(frame.sun), exposure, 0.01) << frame.frame_index;
    EXPECT_NEAR(MeanLog(frame.sky), exposure, 0.01) << frame.frame_index;
  }
}

TEST(LightChanges, AreNotProvedByOneTwoOrThreeFrames) {
  for (const std::vector<int>& kept : {std::vector{2}, {2, 8}, {2, 5, 8}, {0, 1, 2}}) {
    const auto cut = [&](std::vector<ProbedFrame>* frames) {
      std::vector<ProbedFrame> few;
      for (const int frame : kept) few.push_back((*frames)[frame]);
      *frames = few;
    };
    const LightChanges found = FollowSpoiled(CloudedFilm(), cut, {});
    EXPECT_FALSE(found.changes);
    ASSERT_EQ(found.frames.size(), kept.size());
    for (const FrameLight& frame : found.frames) {
      EXPECT_TRUE(std::isfinite(MeanLog(frame.sun)) && std::isfinite(MeanLog(frame.sky)));
      EXPECT_NEAR(frame.LogRatio(), 0.0, 0.1) << "one light for all frames";
    }
  }
}

TEST(LightChanges, AreNoneInSteadyLight) {
  const auto moment = [](int) { return Moment{}; };
  const LightChanges found = Follow(moment);
  EXPECT_FALSE(found.changes);
  const LightErrors errors = ErrorsOf(found.frames, moment);
  EXPECT_LE(errors.sun_rms, 0.01);
  EXPECT_LE(errors.sky_rms, 0.01);
  for (int i = 1; i + 1 < kFrames; ++i) {
    const double second = MeanLog(found.frames[i - 1].sun) - 2 * MeanLog(found.frames[i].sun) +
                          MeanLog(found.frames[i + 1].sun);
    EXPECT_LE(std::fabs(second), 0.01) << "flicker";
  }
}

TEST(LightChanges, AreNoneWhereOnlyTheExposureChanges) {
  const auto moment = [](int frame) { return Moment{1.0, 1.0, frame < 8 ? 1.0 : 0.7}; };
  const LightChanges found = Follow(moment);
  EXPECT_FALSE(found.changes);
  EXPECT_LE(ErrorsOf(found.frames, moment).largest, 0.03);
}

TEST(LightChanges, FollowACloudUnderATreeThatNoPhantomStandsFor) {
  PhotographedYard::Light light;
  light.shaded = [](Vec3 p) { return p.x < -0.2; };
  ExpectFollowed(Follow(UnderACloud, light), UnderACloud);
}

TEST(LightChanges, FollowACloudWhilePeopleWalkThroughTheSun) {
  ExpectFollowed(Follow(UnderACloud, {}, WalkThroughTheSun), UnderACloud);
}

}  // namespace
}  // namespace pleinair::compositor
