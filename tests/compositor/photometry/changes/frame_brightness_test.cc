#include "compositor/photometry/changes/frame_brightness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pleinair::compositor {
namespace {

// A camera that pans over thirty frames: each probe is seen in eight of them.
constexpr std::size_t kFrames = 30, kProbes = 120, kSeen = 8;

double LightOf(std::size_t frame) { return 0.3 * std::sin(0.4 * static_cast<double>(frame)); }

std::vector<ProbeFit> Panned() {
  const ProbeLight light{{1, 1, 1}, 1.0, {}, {1, 1, 1}};
  std::vector<ProbeFit> probes(kProbes, ProbeFit(light, 0));
  for (std::size_t t = 0; t < kFrames; ++t) {
    for (std::size_t i = 0; i < kProbes; ++i) {
      const std::size_t first = i * (kFrames + kSeen) / kProbes;
      if (t + kSeen < first || t >= first) continue;
      const double albedo = 0.1 + 0.005 * static_cast<double>(i);
      const double noise = 0.01 * std::sin(static_cast<double>(i * 37 + t * 11));
      const auto value = static_cast<float>(albedo * std::exp(LightOf(t) + noise));
      probes[i].Add(t, {value, value, value});
    }
  }
  return probes;
}

bool All(const ProbeFit& /*probe*/) { return true; }

TEST(FrameBrightness, FollowsACameraThatMovesOnToOtherSurfaces) {
  const auto brightness = FrameBrightness(Panned(), kFrames, 1, All);
  for (std::size_t t = 0; t < kFrames; ++t) {
    ASSERT_TRUE(brightness[t]) << t;
    EXPECT_NEAR(*brightness[t] - *brightness[0], LightOf(t) - LightOf(0), 0.04) << t;
  }
}

TEST(FrameBrightness, ContinuesBehindFramesThatShowNothing) {
  std::vector<ProbeFit> probes(10, ProbeFit(ProbeLight{{1, 1, 1}, 1.0, {}, {1, 1, 1}}, 0));
  for (ProbeFit& probe : probes) {
    probe.Add(0, {0.2F, 0.2F, 0.2F});
    probe.Add(3, {0.4F, 0.4F, 0.4F});
  }
  const auto brightness = FrameBrightness(probes, 4, 1, All);
  EXPECT_FALSE(brightness[1]);
  EXPECT_FALSE(brightness[2]);
  ASSERT_TRUE(brightness[0] && brightness[3]);
  EXPECT_NEAR(*brightness[3] - *brightness[0], std::log(2.0), 1e-6);
}

TEST(FrameBrightness, IsUnknownOfFramesWithTooFewProbes) {
  for (const auto& brightness : FrameBrightness(Panned(), kFrames, kProbes, All)) {
    EXPECT_FALSE(brightness);
  }
  const auto none = [](const ProbeFit& probe) { return !probe.IsSunlit(); };
  for (const auto& brightness : FrameBrightness(Panned(), kFrames, 1, none)) {
    EXPECT_FALSE(brightness);
  }
}

}  // namespace
}  // namespace pleinair::compositor
