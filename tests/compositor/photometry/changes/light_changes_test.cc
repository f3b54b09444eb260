#include "compositor/photometry/changes/light_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;

const PhotographedYard& Yard() {
  static const PhotographedYard yard;
  return yard;
}

constexpr int kFrames = 18;
constexpr double kFrameSeconds = 0.25;

/// Light of a frame: what a cloud and the camera make of it.
struct Moment {
  double sun = 1.0, sky = 1.0, exposure = 1.0;
};

/// The sun falls to a tenth within a second and a half and returns; the sky rises by a fifth.
Moment UnderACloud(int frame) {
  const double cloud = std::clamp(std::min(frame - 2, 15 - frame) / 6.0, 0.0, 1.0);
  return {std::pow(0.1, cloud), 1.0 + 0.2 * cloud, 1.0};
}

using Disturb = std::function<void(int frame, RgbImage*)>;

/// Films the yard and fits its light. The first two frames are the reference.
LightChanges Follow(const std::function<Moment(int)>& moment, PhotographedYard::Light light = {},
                    const Disturb& disturb = {}, std::size_t max_readings = 100'000,
                    const std::function<void(std::vector<ProbedFrame>*)>& spoil = {}) {
  const PhotographedYard& yard = Yard();
  LightProbes probes(yard.phantoms(), yard.camera(), {}, max_readings);
  for (int frame = 0; frame < kFrames; ++frame) {
    const Moment now = moment(frame);
    light.sun_scale = now.sun;
    light.sky_radiance_scale = {now.sky, now.sky, now.sky};
    light.exposure = now.exposure;
    RgbImage image = yard.Photograph(frame % 2, light);
    if (disturb) disturb(frame, &image);
    probes.AddFrame(image.view(), PhotographedYard::Pose(frame % 2), yard.marker(), frame,
                    static_cast<std::int64_t>(1e9 * kFrameSeconds * frame));
  }
  std::size_t readings = 0;
  for (const ProbedFrame& frame : probes.frames()) readings += frame.probes.size();
  EXPECT_LE(readings, max_readings);
  const auto lights =
      LightOn(probes.probes(), yard.phantoms(), yard.model(), yard.marker_from_world());
  auto frames = probes.frames();
  if (spoil) spoil(&frames);
  return FitLightChanges(frames, probes.probes(), lights, {0, 1});
}

struct Errors {
  double sun_rms = 0.0, sky_rms = 0.0, largest = 0.0;
};

Errors ErrorsOf(const LightChanges& found, const std::function<Moment(int)>& moment) {
  Errors errors;
  for (int frame = 0; frame < kFrames; ++frame) {
    const Moment now = moment(frame), first = moment(0);
    const double sun =
        MeanLog(found.frames[frame].sun) - std::log(now.sun * now.exposure / first.exposure);
    const double sky =
        MeanLog(found.frames[frame].sky) - std::log(now.sky * now.exposure / first.exposure);
    errors.sun_rms += sun * sun / kFrames;
    errors.sky_rms += sky * sky / kFrames;
    errors.largest = std::max({errors.largest, std::fabs(sun), std::fabs(sky)});
  }
  errors.sun_rms = std::sqrt(errors.sun_rms);
  errors.sky_rms = std::sqrt(errors.sky_rms);
  ::testing::Test::RecordProperty("sun_rms", std::to_string(errors.sun_rms));
  ::testing::Test::RecordProperty("sky_rms", std::to_string(errors.sky_rms));
  return errors;
}

void ExpectFollowed(const LightChanges& found, const std::function<Moment(int)>& moment) {
  const Errors errors = ErrorsOf(found, moment);
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
  const LightChanges found = Follow(UnderACloud, {}, {}, 100'000, cover);
  EXPECT_TRUE(found.changes);
  for (const int frame : {1, 8, 16}) {
    const Moment now = UnderACloud(frame);
    EXPECT_NEAR(MeanLog(found.frames[frame].sun), std::log(now.sun), 0.1) << frame;
    EXPECT_NEAR(MeanLog(found.frames[frame].sky), std::log(now.sky), 0.05) << frame;
  }
}

TEST(LightChanges, FollowACloudOverACameraThatMovesOn) {
  // Each probe is seen for six frames.
  const auto pan = [](std::vector<ProbedFrame>* frames) {
    for (std::size_t t = 0; t < frames->size(); ++t) {
      ProbedFrame& frame = (*frames)[t];
      std::size_t kept = 0;
      for (std::size_t k = 0; k < frame.probes.size(); ++k) {
        const std::size_t first_seen = frame.probes[k] * 7 % (kFrames + 5);
        if (t + 5 < first_seen || t > first_seen) continue;
        frame.probes[kept] = frame.probes[k];
        frame.linear[kept++] = frame.linear[k];
      }
      frame.probes.resize(kept);
      frame.linear.resize(kept);
    }
  };
  const LightChanges found = Follow(UnderACloud, {}, {}, 100'000, pan);
  EXPECT_LE(ErrorsOf(found, UnderACloud).largest, 0.3);
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
  EXPECT_FALSE(Follow([](int) { return Moment{}; }, {}, {}, 100'000, pan).changes);
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

TEST(LightChanges, AreNoneInSteadyLight) {
  const auto moment = [](int) { return Moment{}; };
  const LightChanges found = Follow(moment);
  EXPECT_FALSE(found.changes);
  const Errors errors = ErrorsOf(found, moment);
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
  EXPECT_LE(ErrorsOf(found, moment).largest, 0.03);
}

TEST(LightChanges, FollowACloudUnderATreeThatNoPhantomStandsFor) {
  PhotographedYard::Light light;
  light.shaded = [](Vec3 p) { return p.x < -0.2; };
  ExpectFollowed(Follow(UnderACloud, light), UnderACloud);
}

TEST(LightChanges, FollowACloudWhilePeopleWalkThroughTheSun) {
  // They cover a third of the image from the fifth frame on, in the light of their frame and in
  // clothes of any brightness.
  const auto people = [](int frame, RgbImage* image) {
    if (frame < 5) return;
    const double light = 0.8 * UnderACloud(frame).sun + 0.2 * UnderACloud(frame).sky;
    for (int y = 0; y < image->height(); ++y) {
      for (int x = 0; x < image->width() / 3; ++x) {
        const double cloth = 0.02 + 0.003 * ((x / 16 * 53 + y / 16 * 29 + frame) % 160);
        for (int c = 0; c < 3; ++c) {
          (*image)(x + 8 * frame, y, c) = CameraResponse{}.Encoded8(cloth * light, c);
        }
      }
    }
  };
  ExpectFollowed(Follow(UnderACloud, {}, people), UnderACloud);
}

}  // namespace
}  // namespace pleinair::compositor
