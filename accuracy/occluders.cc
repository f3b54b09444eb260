#include "accuracy/occluders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "accuracy/occluder_masks.h"
#include "accuracy/point_spread.h"
#include "accuracy/random.h"

namespace pleinair::accuracy {
namespace {

constexpr int kTexels = Occluder::kTexels;

/// Linear reflectances of skin, as luminance (from five linear RGB albedos of skins).
constexpr std::array<double, 5> kSkin{0.348, 0.471, 0.225, 0.127, 0.560};

/// Skin: darker towards the outline, where it curves away, and grained.
Image<float> PaintSkin(const Image<float>& distance, RandomStream* random) {
  constexpr double kRoundness = 0.07;  // In edges.
  constexpr double kGrain = 0.25, kGrainBlur_texels = 2.2;
  const double base =
      kSkin[random->Below(static_cast<int>(kSkin.size()))] * random->Uniform(.8, 1.1);
  Image<float> grain(kTexels, kTexels);
  for (std::size_t i = 0; i < grain.size(); ++i) grain.data()[i] = random->NormalFromWord();
  grain = GaussianBlurred(grain, kGrainBlur_texels);
  Image<float> light(kTexels, kTexels);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double depth = std::clamp(-distance.data()[i] / kRoundness, 0.0, 1.0);
    const double shade = .55 + .45 * std::pow(depth, .6);
    light.data()[i] =
        static_cast<float>(std::clamp(base * shade * (1.0 + kGrain * grain.data()[i]), 0.0, 1.0));
  }
  return light;
}

/// Card or cloth: one tone between black and white, with a ramp.
Image<float> PaintFlat(RandomStream* random) {
  constexpr std::array<std::array<double, 2>, 4> kTones{
      {{.02, .1}, {.15, .5}, {.6, .85}, {.1, .5}}};
  const auto [low, high] = kTones[random->Below(4)];
  const double base = random->Uniform(low, high);
  const double ramp_u = random->Uniform(-1, 1), ramp_v = random->Uniform(-1, 1);
  Image<float> light(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const double u = (x + 0.5) / kTexels * 2.5 - 1.25, v = (y + 0.5) / kTexels * 2.5 - 1.25;
      const double ramp = std::clamp(1.0 + .35 * (u * ramp_u + v * ramp_v), .3, 1.7);
      light(x, y) = static_cast<float>(std::min(base * ramp, 1.0));
    }
  }
  return light;
}

/// The soft shadow that it casts beside itself.
Image<float> PaintShadow(const Image<float>& cover, RandomStream* random) {
  constexpr double kSoftness = 0.02, kMaxShift = 0.035;  // In edges.
  const int dx = static_cast<int>(
      std::lround(random->Uniform(-kMaxShift, kMaxShift) * Occluder::kTexelsPerEdge));
  const int dy = static_cast<int>(
      std::lround(random->Uniform(-kMaxShift, kMaxShift) * Occluder::kTexelsPerEdge));
  const double depth = random->Uniform(.15, .45);
  const Image<float> soft = GaussianBlurred(cover, kSoftness * Occluder::kTexelsPerEdge);
  Image<float> shadow(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      const int from_x = x - dx, from_y = y - dy;
      const bool inside = from_x >= 0 && from_y >= 0 && from_x < kTexels && from_y < kTexels;
      shadow(x, y) = inside ? static_cast<float>(depth) * soft(from_x, from_y) : 0.0F;
    }
  }
  return shadow;
}

double ExtentOf(const Image<float>& cover) {
  constexpr double kShadowReach = 0.08;  // In edges.
  int low = kTexels, high = -1;
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      if (cover(x, y) == 0.0F) continue;
      low = std::min({low, x, y});
      high = std::max({high, x, y});
    }
  }
  if (high < 0) return 0.0;
  const auto place = [](int texel) {
    return Occluder::kFirst + (texel + 0.5) / Occluder::kTexelsPerEdge;
  };
  const double reach = std::max(0.5 - place(low), place(high) - 0.5) + kShadowReach;
  return 2.0 * std::min(reach, Occluder::kLast - 0.5);
}

}  // namespace

const std::vector<std::string>& BorderPatterns() {
  static const std::vector<std::string> kNames{"corner1", "corners2",  "corners4",
                                               "side1",   "sides2opp", "sides2adj",
                                               "fingers", "blobs",     "hand"};
  return kNames;
}

const std::vector<std::string>& ContentPatterns() {
  static const std::vector<std::string> kNames{"cblobs", "cbar", "cfinger", "chand"};
  return kNames;
}

double MaxShare(const std::string& pattern) {
  if (pattern == "corner1" || pattern == "sides2adj") return .55;
  if (pattern == "side1") return .32;
  if (pattern == "sides2opp") return .65;
  return pattern == "hand" ? .21 : 1.0;
}

Occluder MakeOccluder(const OccluderSpec& spec, std::uint64_t seed) {
  RandomStream shape(seed, "occluder shape/" + spec.key);
  RandomStream look(seed, "occluder look/" + spec.key);
  OccluderMask mask = MakeOccluderMask(spec.pattern, spec.share, &shape);
  Occluder occluder;
  occluder.light = mask.distance.empty() ? PaintFlat(&look) : PaintSkin(mask.distance, &look);
  occluder.shadow = PaintShadow(mask.cover, &look);
  occluder.shares = SharesOf(mask.cover);
  occluder.extent = ExtentOf(mask.cover);
  occluder.cover = std::move(mask.cover);
  return occluder;
}

}  // namespace pleinair::accuracy
