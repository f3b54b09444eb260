#include "compositor/light/changing/contact_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel_for.h"
#include "compositor/light/changing/round_samples.h"
#include "compositor/light/gather_origin.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

constexpr std::size_t kPlacesPerBlock = 32;
// Effective rays of a vertex, as those of probes (body_probes.cc).
constexpr float kMaxRaysBesideRest = 512.0F, kMaxRaysBesideMoving = 48.0F;
// Effective rays of a vertex from which on the sunlight that is missing is taken off as a whole.
constexpr float kShadedRays = 128.0F;
// Share of the sunlight missing until a movement that each frame keeps, and below which none is
// left.
constexpr float kFadeOut = 0.8F, kMinFading_lux = 0.5F;
// Path of the bodies after which older rays no longer count, relative to the distance.
constexpr double kForgetShare = 0.05, kMinForget_m = 5e-3, kRestPath_m = 1e-3;
// Vertices next to the bodies: within this distance of the sphere around them.
constexpr double kNext_m = 0.3;
// The list of near vertices reaches this much farther, so that it is seldom made again.
constexpr double kListMargin_m = 0.5;
// Inside of the sphere around the bodies, or almost, rays go everywhere above the surface.
constexpr double kOutside = 1.1;

Vec3 VectorOf(const Float3& a) { return {a[0], a[1], a[2]}; }

}  // namespace

ContactLight::ContactLight(std::span<const LitMesh> still) : still_(still) {
  changes_.reserve(still.size());
  for (const LitMesh& mesh : still) changes_.emplace_back(mesh.positions.size());
}

void ContactLight::FadeShaded() {
  for (const auto& [m, v] : near_) {
    Change& change = changes_[m][v];
    if (change.shaded_rays == 0.0F || path_m_ - change.path_m < kRestPath_m) continue;
    const float share = std::min(1.0F, change.shaded_rays / kShadedRays);
    for (std::size_t c = 0; c < 3; ++c) change.fading[c] += share * change.shaded[c];
    change.shaded_rays = 0.0F;
  }
}

void ContactLight::FollowBodies(std::span<const LitMesh> bodies, double moved_m) {
  path_m_ += moved_m;
  FadeShaded();
  Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  for (const LitMesh& body : bodies) {
    for (const auto& [x, y, z] : body.positions) {
      low = {std::min<double>(low.x, x), std::min<double>(low.y, y), std::min<double>(low.z, z)};
      high = {std::max<double>(high.x, x), std::max<double>(high.y, y),
              std::max<double>(high.z, z)};
    }
  }
  if (low.x > high.x) return;
  bodies_.centre = (low + high) * 0.5;
  bodies_.radius_m = 0.5 * Norm(high - low);
  const bool listed =
      near_of_.radius_m > 0.0 && Norm(bodies_.centre - near_of_.centre) + bodies_.radius_m <=
                                     near_of_.radius_m + kListMargin_m;
  if (listed) return;
  near_of_ = bodies_;
  left_.insert(left_.end(), near_.begin(), near_.end());
  near_.clear();
  const double reach_m = bodies_.radius_m + kReach_m + kListMargin_m;
  for (std::uint32_t m = 0; m < still_.size(); ++m) {
    for (std::uint32_t v = 0; v < still_[m].positions.size(); ++v) {
      if (Norm(VectorOf(still_[m].positions[v]) - bodies_.centre) < reach_m) {
        near_.push_back({m, v});
      } else {
        changes_[m][v] = {};
      }
    }
  }
  const double next_m = bodies_.radius_m + kNext_m + kListMargin_m;
  const auto far_off = std::stable_partition(near_.begin(), near_.end(), [&](const Place& place) {
    return Norm(VectorOf(still_[place.mesh].positions[place.vertex]) - bodies_.centre) < next_m;
  });
  const auto close = static_cast<std::size_t>(far_off - near_.begin());
  turns_[0] = {0, close, 0};
  turns_[1] = {close, near_.size() - close, 0};
}

void ContactLight::Forget() {
  for (auto& mesh : changes_) {
    for (Change& change : mesh) {
      change.rays = change.shaded_rays = 0.0F;
      change.fading = {};
    }
  }
}

void ContactLight::Refresh(const Surroundings& surroundings, std::size_t vertices) {
  const bool all = vertices >= near_.size();
  Refresh(surroundings, all ? vertices : vertices * 2 / 3, &turns_[0]);
  Refresh(surroundings, all ? vertices : vertices / 3, &turns_[1]);
}

void ContactLight::Refresh(const Surroundings& surroundings, std::size_t vertices, Turns* turns) {
  const std::size_t count = std::min(vertices, turns->size);
  ParallelFor((count + kPlacesPerBlock - 1) / kPlacesPerBlock, 0, [&](std::size_t block) {
    const std::size_t last = std::min(count, (block + 1) * kPlacesPerBlock);
    for (std::size_t i = block * kPlacesPerBlock; i < last; ++i) {
      Trace(surroundings, turns->begin + (turns->next + i) % turns->size);
    }
  });
  if (count > 0) turns->next = (turns->next + count) % turns->size;
}

void ContactLight::Trace(const Surroundings& surroundings, std::size_t index) {
  const auto& [m, v] = near_[index];
  const LitMesh& mesh = still_[m];
  Change& change = changes_[m][v];
  const Vec3 normal = VectorOf(mesh.normals[v]);
  const Vec3 origin = VectorOf(mesh.positions[v]) + normal * kRayOffset_m;
  const Vec3 to_bodies = bodies_.centre - origin;
  const double distance_m = Norm(to_bodies);
  Float3 light{}, sunlight{};
  const bool may_see =
      distance_m < bodies_.radius_m + kReach_m && Dot(to_bodies, normal) > -bodies_.radius_m;
  if (may_see) {
    const bool in_cone = distance_m > kOutside * bodies_.radius_m;
    const double share = bodies_.radius_m / distance_m;
    const double cap = in_cone ? 1.0 - std::sqrt(1.0 - share * share) : 1.0;
    const TangentFrame frame(in_cone ? to_bodies * (1.0 / distance_m) : normal);
    const RoundSamples samples(kRays, change.round, Hash(m, v));
    const std::array<float, 3>& received = mesh.ambient_with[v];
    const Float3 reflected =
        mesh.sunlight.reflected_with.empty() ? Float3{} : mesh.sunlight.reflected_with[v];
    for (std::uint32_t i = 0; i < kRays; ++i) {
      const SamplePoint point = samples[i];
      Vec3 direction = CosineDirection(frame, point);
      double weight = std::numbers::pi / kRays;
      if (in_cone) {
        const double height = 1.0 - cap * point.u, turn = 2.0 * std::numbers::pi * point.v;
        const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
        direction = frame.ToWorld(radius * std::cos(turn), radius * std::sin(turn), height);
        weight = 2.0 * std::numbers::pi * cap / kRays * std::max(0.0, Dot(direction, normal));
      }
      if (weight <= 0.0) continue;
      const auto seen = surroundings.LookAtBodies(origin, direction);
      if (!seen) continue;
      const auto w = static_cast<float>(weight);
      const bool before_sky = surroundings.sky().SineElevation(direction) >= 0.0 &&
                              !surroundings.IsBehindStill(origin, direction);
      const Float3 sky = before_sky ? surroundings.sky().Radiance(direction) : Float3{};
      for (std::size_t c = 0; c < 3; ++c) {
        constexpr float kShare = std::numbers::inv_pi_v<float>;
        light[c] += w * (seen->radiance[c] - (before_sky ? sky[c] : kShare * received[c]));
        sunlight[c] += w * (seen->sunlight[c] - (before_sky ? 0.0F : kShare * reflected[c]));
      }
    }
  }
  ++change.round;
  const double moved_m = path_m_ - change.path_m;
  change.path_m = path_m_;
  const double forget_m = std::max(kMinForget_m, kForgetShare * (distance_m - bodies_.radius_m));
  const float most = moved_m < kRestPath_m ? kMaxRaysBesideRest
                     : moved_m < forget_m  ? kMaxRaysBesideMoving
                                           : kRays;
  if (moved_m < kRestPath_m && may_see) {
    TraceShaded(surroundings, origin, normal, Hash(v, m), &change);
  }
  change.rays = std::min(change.rays, most - kRays) + kRays;
  const float weight = static_cast<float>(kRays) / change.rays;
  for (std::size_t c = 0; c < 3; ++c) {
    change.light[c] += weight * (light[c] - change.light[c]);
    change.sunlight[c] += weight * (sunlight[c] - change.sunlight[c]);
  }
}

void ContactLight::TraceShaded(const Surroundings& surroundings, Vec3 origin, Vec3 normal,
                               std::uint32_t seed, Change* change) {
  const TangentFrame frame(normal);
  const RoundSamples samples(kRays, change->round, seed);
  Float3 shaded{};
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const Vec3 direction = CosineDirection(frame, samples[i]);
    const Float3 missing = surroundings.ShadedSunlight(origin, direction);
    for (std::size_t c = 0; c < 3; ++c) {
      shaded[c] += missing[c] * std::numbers::pi_v<float> / static_cast<float>(kRays);
    }
  }
  if (change->shaded_rays == 0.0F) change->shaded = {};
  change->shaded_rays = std::min(change->shaded_rays, kMaxRaysBesideRest - kRays) + kRays;
  const float weight = static_cast<float>(kRays) / change->shaded_rays;
  for (std::size_t c = 0; c < 3; ++c) {
    change->shaded[c] += weight * (shaded[c] - change->shaded[c]);
  }
}

void ContactLight::FadeOut() {
  for (const auto& [m, v] : near_) {
    for (float& fading : changes_[m][v].fading) {
      fading *= fading > kMinFading_lux ? kFadeOut : 0.0F;
    }
  }
}

void ContactLight::Light(std::span<LitMesh> drawn) {
  for (const auto& [m, v] : left_) {
    const LitMesh& mesh = still_[m];
    drawn[m].ambient_with[v] = mesh.ambient_with[v];
    if (mesh.sunlight.reflected_with.empty()) continue;
    drawn[m].sunlight.reflected_with[v] = mesh.sunlight.reflected_with[v];
  }
  left_.clear();
  for (const auto& [m, v] : near_) {
    const LitMesh& mesh = still_[m];
    const Change& change = changes_[m][v];
    const float share = std::min(1.0F, change.shaded_rays / kShadedRays);
    for (std::size_t c = 0; c < 3; ++c) {
      const float shaded = share * change.shaded[c] + change.fading[c];
      const float light = std::max(0.0F, mesh.ambient_with[v][c] + change.light[c] - shaded);
      drawn[m].ambient_with[v][c] = light;
      if (mesh.sunlight.reflected_with.empty()) continue;
      drawn[m].sunlight.reflected_with[v][c] =
          std::clamp(mesh.sunlight.reflected_with[v][c] + change.sunlight[c] - shaded, 0.0F, light);
    }
  }
}

}  // namespace pleinair::compositor
