// Follows the light of a yard under a cloud as a live session does, frame by frame.

#include "session/following/forward_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "base/quantile.h"
#include "compositor/photometry/changes/light_probes.h"
#include "devices/frame.h"
#include "session/following/light_on_marker.h"
#include "session/following/live_light.h"
#include "tests/compositor/photometry/changes/clouded_yard.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::session {
namespace {

using compositor::testing::kYardFrames;
using compositor::testing::kYardFrameSeconds;
using compositor::testing::Moment;
using compositor::testing::PhotographedYard;
using compositor::testing::UnderACloud;
using compositor::testing::Yard;

// Steady frames before the film: in the first, probes are found; in the second, the light starts.
constexpr int kBefore = 2;
// The first frame under the cloud: the next one proves that the light changes.
constexpr int kProof = 3;

std::int64_t StampOf(int frame) {
  return static_cast<std::int64_t>(1e9 * kYardFrameSeconds * (frame + kBefore));
}

LightReference Reference() {
  return {{std::shared_ptr<const void>(), &Yard().phantoms()},
          {std::shared_ptr<const void>(), &Yard().model()},
          Yard().marker_from_world()};
}

/// Light that the marker reflects in a frame, over that of the reference, by its probes.
LinearRgb LightOfMarker(const Moment& now) {
  static const LightOnMarker on_marker = [] {
    compositor::LightProbes probes(Yard().phantoms(), Yard().camera(), {});
    const RgbImage image = Yard().Photograph(0, {});
    probes.AddFrame(image.view(), PhotographedYard::Pose(0), Yard().marker(), 0, 0);
    const auto lights = compositor::LightOn(probes.probes(), Yard().phantoms(), Yard().model(),
                                            Yard().marker_from_world());
    LightOnMarker sum;
    for (std::size_t i = 0; i < lights.size(); ++i) sum.Add(probes.probes()[i], lights[i]);
    return sum;
  }();
  const LinearRgb one{1.0, 1.0, 1.0};
  return on_marker.Factor(one * (now.sun * now.exposure), one * (now.sky * now.exposure));
}

/// Photographs frame `frame` of a film. Those before 0 are as the first one. A photograph of the
/// same pose and sun is taken once.
RgbImage Photograph(const std::function<Moment(int)>& moment, int frame) {
  const Moment now = moment(std::max(frame, 0));
  const int pose = (frame + kBefore) % 2;
  static std::map<std::pair<int, double>, RgbImage> taken;
  RgbImage& one = taken[{pose, now.sun}];
  if (one.empty()) {
    PhotographedYard::Light light;
    light.sun_scale = now.sun;
    light.sky_radiance_scale = {now.sky, now.sky, now.sky};
    one = Yard().Photograph(pose, light);
  }
  RgbImage image = CopyImage<std::uint8_t>(one.view());
  const CameraResponse srgb;
  for (std::size_t i = 0; now.exposure != 1.0 && i < image.size(); ++i) {
    image.data()[i] = srgb.Encoded8(srgb.Linear(0)[image.data()[i]] * now.exposure, 0);
  }
  return image;
}

void LightProbesOf(ForwardFollower* follower) {
  while (const auto wanted = follower->ProbesWithoutLight()) {
    follower->AddLights(wanted->reference,
                        compositor::LightOn(wanted->probes, *wanted->light.phantoms,
                                            *wanted->light.day, wanted->light.marker_from_world));
  }
}

/// Factors on sun and sky with which an object is drawn, logarithms: those of FollowedLight, with
/// an exposure scale that the marker gives.
struct DrawnLight {
  FollowedLight followed;
  double sun = 0.0, sky = 0.0;
};

/// Films the yard and follows its light. `before`: called before each frame.
std::vector<DrawnLight> Follow(
    const std::function<Moment(int)>& moment,
    const std::function<void(int, ForwardFollower*)>& before = [](int, ForwardFollower*) {}) {
  ForwardFollower follower(Yard().camera(), {});
  follower.Use(Reference());
  std::vector<DrawnLight> drawn;
  std::vector<double> cpu_ms;
  for (int frame = -kBefore; frame < kYardFrames; ++frame) {
    before(frame, &follower);
    const RgbImage image = Photograph(moment, frame);
    const std::clock_t start = std::clock();
    follower.Add(image.view(), PhotographedYard::Pose((frame + kBefore) % 2), Yard().marker(),
                 frame + kBefore, StampOf(frame));
    cpu_ms.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    LightProbesOf(&follower);
    if (frame < 0) continue;
    DrawnLight light{follower.Newest()};
    const LinearRgb scale = LightOfMarker(moment(frame)) / LightOfMarker(moment(0)) /
                            light.followed.marker_light * light.followed.exposure;
    light.sky = MeanLog(scale);
    light.sun = MeanLog(scale * light.followed.mix.sun);
    drawn.push_back(light);
  }
  ::testing::Test::RecordProperty("median_cpu_ms", std::to_string(Median(cpu_ms)));
  ::testing::Test::RecordProperty("worst_cpu_ms", std::to_string(Quantile(cpu_ms, 1.0)));
  return drawn;
}

void ExpectFollowed(const std::vector<DrawnLight>& drawn,
                    const std::function<Moment(int)>& moment) {
  double sun = 0.0, sky = 0.0;
  for (int frame = 0; frame < kYardFrames; ++frame) {
    const Moment now = moment(frame), first = moment(0);
    const double exposure = std::log(now.exposure / first.exposure);
    if (frame == kProof) continue;
    sun += std::pow(drawn[frame].sun - std::log(now.sun) - exposure, 2) / kYardFrames;
    sky += std::pow(drawn[frame].sky - std::log(now.sky) - exposure, 2) / kYardFrames;
  }
  ::testing::Test::RecordProperty("sun_rms", std::to_string(std::sqrt(sun)));
  ::testing::Test::RecordProperty("sky_rms", std::to_string(std::sqrt(sky)));
  EXPECT_LE(std::sqrt(sun), 0.05);
  EXPECT_LE(std::sqrt(sky), 0.04);
}

TEST(ForwardFollower, FollowsACloud) { ExpectFollowed(Follow(UnderACloud), UnderACloud); }

TEST(ForwardFollower, FollowsACloudThatTheExposureFollows) {
  const auto moment = [](int frame) {
    Moment now = UnderACloud(frame);
    now.exposure = 1.0 / (0.5 * now.sun + 0.5);
    return now;
  };
  ExpectFollowed(Follow(moment), moment);
}

TEST(ForwardFollower, ChangesNothingInSteadyLight) {
  const auto moment = [](int frame) { return Moment{1.0, 1.0, frame < 8 ? 1.0 : 0.7}; };
  for (const DrawnLight& light : Follow(moment)) {
    EXPECT_EQ(light.followed.mix, compositor::LightMix{});
    EXPECT_EQ(light.followed.exposure, (LinearRgb{1.0, 1.0, 1.0}));
    EXPECT_EQ(light.followed.marker_light, (LinearRgb{1.0, 1.0, 1.0}));
  }
}

/// The cloud has passed by the eighth frame.
Moment ShortCloud(int frame) { return UnderACloud(std::min(2 * frame, kYardFrames - 1)); }

TEST(ForwardFollower, DoesNotFlickerOnceTheLightIsSteadyAgain) {
  const std::vector<DrawnLight> drawn = Follow(ShortCloud);
  EXPECT_NE(drawn.back().followed.mix, compositor::LightMix{}) << "changes are followed";
  for (int frame = 10; frame < kYardFrames; ++frame) {
    EXPECT_LE(std::fabs(drawn[frame].sun - drawn[frame - 1].sun), 0.01) << frame;
    EXPECT_LE(std::fabs(drawn[frame].sky - drawn[frame - 1].sky), 0.01) << frame;
  }
}

TEST(ForwardFollower, GoesOnWithANewReferenceAfterTheCloud) {
  // Under the cloud there is no full sun, so that the new reference waits.
  const auto move_sun = [](int frame, ForwardFollower* follower) {
    if (frame == 4) follower->Use(Reference());
    if (frame > 4 && frame < 8) {
      EXPECT_FALSE(follower->IsInFullSun()) << frame;
      EXPECT_EQ(follower->reference(), 1) << frame;
    }
    if (frame == kYardFrames - 1) {
      EXPECT_EQ(follower->reference(), 2);
    }
  };
  ExpectFollowed(Follow(UnderACloud, move_sun), UnderACloud);
}

TEST(ForwardFollower, TakesMovedPhantomsAtOnce) {
  const auto move_phantoms = [](int frame, ForwardFollower* follower) {
    LightReference reference = Reference();
    reference.has_moved_phantoms = true;
    if (frame == 4) follower->Use(reference);
    if (frame == 7) {
      EXPECT_FALSE(follower->IsInFullSun());
      EXPECT_EQ(follower->reference(), 2);
    }
  };
  Follow(UnderACloud, move_phantoms);
}

TEST(ForwardFollower, RefersToANewEstimateOfSunOverSky) {
  // What was followed before is part of the estimate: the factors begin at 1.
  const auto estimate = [](int frame, ForwardFollower* follower) {
    LightReference reference = Reference();
    reference.is_new_ratio = true;
    if (frame == 12) follower->Use(reference);
  };
  const std::vector<DrawnLight> drawn = Follow(ShortCloud, estimate);
  EXPECT_NEAR(MeanLog(drawn.back().followed.mix.sun), 0.0, 0.02);
}

TEST(LiveLight, FollowsFramesOnThreadsOfItsOwn) {
  LiveLight light(Yard().camera(), {});
  const auto show = [&](int frame) {
    devices::Frame shown;
    shown.index = frame + kBefore;
    shown.timestamp_ns = StampOf(frame);
    shown.rgb = Photograph(UnderACloud, frame);
    light.Show(std::make_shared<const devices::Frame>(std::move(shown)),
               PhotographedYard::Pose((frame + kBefore) % 2), Yard().marker());
  };
  const auto wait_for = [&](std::int64_t frames) {
    while (light.newest().frames < frames) std::this_thread::yield();
  };
  light.Use(Reference());
  // Frames until the light of the probes is traced.
  std::int64_t frames = 0;
  while (light.Of(kBefore - 1).source == compositor::FrameLight::Source::kHeld) {
    show(-1);
    wait_for(++frames);
  }
  for (const int frame : {0, 2, 4, 6, 8}) {
    show(frame);
    wait_for(++frames);
  }
  EXPECT_LT(MeanLog(light.Of(kBefore + 8).mix.sun), -1.0);
  EXPECT_EQ(light.Of(kBefore + 8).mix, light.Of(kBefore + 100).mix) << "the last one before it";
  EXPECT_EQ(light.Of(kBefore).mix, compositor::LightMix{}) << "of that frame, not the newest";
  EXPECT_FALSE(light.newest().in_full_sun);
  light.Stop();
  show(9);
  EXPECT_EQ(light.newest().frames, frames);
}

}  // namespace
}  // namespace pleinair::session
