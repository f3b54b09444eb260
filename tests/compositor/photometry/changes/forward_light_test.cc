#include "compositor/photometry/changes/forward_light.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <utility>
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

struct Followed {
  std::vector<FrameLight> frames;
  std::vector<bool> changes;
};

Followed Follow(const LightProbes& probes,
                const std::function<void(std::vector<ProbedFrame>*)>& spoil = {}) {
  ForwardLight forward;
  for (const ProbeLight& light :
       LightOn(probes.probes(), Yard().phantoms(), Yard().model(), Yard().marker_from_world())) {
    forward.AddProbe(light);
  }
  auto frames = probes.frames();
  if (spoil) spoil(&frames);
  Followed followed;
  const auto start = std::chrono::steady_clock::now();
  for (const ProbedFrame& frame : frames) {
    followed.frames.push_back(forward.Add(frame));
    followed.changes.push_back(forward.changes());
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  ::testing::Test::RecordProperty("ms", std::to_string(took.count() / frames.size()));
  return followed;
}

void ExpectFollowed(const Followed& found, const std::function<Moment(int)>& moment) {
  const LightErrors errors = ErrorsOf(found.frames, moment);
  EXPECT_TRUE(found.changes[8]);
  EXPECT_LE(errors.sun_rms, 0.05);
  EXPECT_LE(errors.sky_rms, 0.04);
  EXPECT_LE(errors.largest, 0.15);
  int within = 0;
  for (const FrameLight& frame : found.frames) {
    const Moment now = moment(static_cast<int>(frame.frame_index));
    const double off = frame.LogRatio() - std::log(now.sun / now.sky);
    within += std::fabs(off) <= 2 * frame.log_ratio_error + 0.002 ? 1 : 0;
  }
  EXPECT_GE(within, testing::kYardFrames * 9 / 10) << "two standard deviations";
}

TEST(ForwardLight, FollowsACloud) {
  const Followed found = Follow(CloudedFilm());
  ExpectFollowed(found, UnderACloud);
}

TEST(ForwardLight, FollowsACloudThatTheExposureFollows) {
  const auto moment = [](int frame) {
    Moment now = UnderACloud(frame);
    now.exposure = 1.0 / (0.5 * now.sun + 0.5);
    return now;
  };
  ExpectFollowed(Follow(FilmYard(moment)), moment);
}

TEST(ForwardLight, FollowsACloudWhileTheExposureJumps) {
  const auto moment = [](int frame) {
    Moment now = UnderACloud(frame);
    if (frame >= 7) now.exposure = 1.4;
    return now;
  };
  ExpectFollowed(Follow(FilmYard(moment)), moment);
}

TEST(ForwardLight, FollowsACloudUnderATreeThatNoPhantomStandsFor) {
  PhotographedYard::Light light;
  light.shaded = [](Vec3 p) { return p.x < -0.2; };
  ExpectFollowed(Follow(FilmYard(UnderACloud, light)), UnderACloud);
}

TEST(ForwardLight, FollowsACloudWhilePeopleWalkThroughTheSun) {
  ExpectFollowed(Follow(FilmYard(UnderACloud, {}, WalkThroughTheSun)), UnderACloud);
}

TEST(ForwardLight, FollowsACloudWhileAPersonHidesAThirdOfTheSunlitProbes) {
  ExpectFollowed(Follow(CloudedFilm(), HideSunlitProbes), UnderACloud);
}

TEST(ForwardLight, FollowsACloudThatComesWithAHandOverTheMarker) {
  ExpectFollowed(Follow(CloudedFilm(), CoverTheMarker), UnderACloud);
}

TEST(ForwardLight, FollowsACloudBehindAGapInWhichNoFrameHasAPose) {
  // The film goes on under the darkest part of the cloud.
  const auto cut = [](std::vector<ProbedFrame>* frames) {
    frames->erase(frames->begin() + 3, frames->begin() + 8);
  };
  for (const FrameLight& frame : Follow(CloudedFilm(), cut).frames) {
    const Moment now = UnderACloud(static_cast<int>(frame.frame_index));
    EXPECT_NEAR(MeanLog(frame.sun), std::log(now.sun), 0.15) << frame.frame_index;
    EXPECT_NEAR(MeanLog(frame.sky), std::log(now.sky), 0.08) << frame.frame_index;
  }
}

TEST(ForwardLight, TakesLampsThatFlickerForExposure) {
  const auto moment = [](int frame) { return Moment{1.0, 1.0, UnderLamps(frame)}; };
  const Followed found = Follow(FilmYard(moment), FilmAt30Hz);
  EXPECT_FALSE(found.changes.back());
  for (const FrameLight& frame : found.frames) EXPECT_NEAR(frame.LogRatio(), 0.0, 0.02);
}

TEST(ForwardLight, FollowsACloudOverACameraThatMovesOn) {
  const Followed found = Follow(CloudedFilm(), MoveOn);
  EXPECT_LE(ErrorsOf(found.frames, UnderACloud).largest, 0.3);
}

TEST(ForwardLight, ChangesNothingInSteadyLight) {
  const auto moment = [](int frame) { return Moment{1.0, 1.0, frame < 8 ? 1.0 : 0.7}; };
  const Followed found = Follow(FilmYard(moment));
  EXPECT_FALSE(found.changes.back());
  EXPECT_LE(ErrorsOf(found.frames, moment).largest, 0.03);
}

}  // namespace
}  // namespace pleinair::compositor
