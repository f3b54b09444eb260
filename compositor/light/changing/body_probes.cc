#include "compositor/light/changing/body_probes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/changing/round_samples.h"
#include "compositor/light/gather_origin.h"
#include "compositor/light/sampling.h"
#include "compositor/light/tessellation.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

// Probes of all bodies: enough for the light on a body, few enough to refresh them in some frames.
constexpr std::size_t kMaxProbes = 2048;
constexpr std::size_t kProbesPerBlock = 8, kLitVerticesPerBlock = 2048;
// Triangles of a surface that rays see as they are: they take about 4 ms to refit.
constexpr std::size_t kMaxFineTriangles = 12'000;
// Effective rays of a probe at rest, and of one that moves. 16 rays have a standard deviation of
// 12 % of the full light at worst, 1024 of 1.5 %.
constexpr float kMaxRaysAtRest = 1024.0F, kMaxRaysMoving = 48.0F;
// Effective rays from which on the sky's radiance along them replaces its harmonics in a cone.
constexpr float kRaysOfSky = 256.0F;
// At rest: moved by less than this, and turned by less than this sine, since the last refresh.
constexpr double kRest_m = 1e-3, kRestTurn = 0.01;
// A probe that moved or turned by more keeps no older rays but one round.
constexpr double kFar_m = 0.05, kFarTurn = 0.3;

Vec3 WideVector(const Float3& a) { return {a[0], a[1], a[2]}; }

void Blend(const Float3& sample, float weight, Float3* value) {
  for (std::size_t c = 0; c < 3; ++c) (*value)[c] += weight * (sample[c] - (*value)[c]);
}

void AddTo(const Float3& value, float weight, Float3* sum) {
  for (std::size_t c = 0; c < 3; ++c) (*sum)[c] += weight * value[c];
}

/// The first corner of one triangle of each vertex.
std::vector<std::uint32_t> FirstCorners(const SurfaceMesh& surface) {
  std::vector<std::uint32_t> corners(surface.positions.size());
  for (std::size_t i = 0; i < surface.indices.size(); ++i) {
    corners[surface.indices[i]] = static_cast<std::uint32_t>(i - i % 3);
  }
  return corners;
}

}  // namespace

BodyProbes::BodyProbes(std::span<const ChangingMesh> bodies) {
  std::vector<SurfaceMesh> surfaces;
  std::vector<const SurfaceMesh*> sources;
  for (const ChangingMesh& body : bodies) {
    for (const SurfaceMesh& surface : body.surfaces()) {
      surfaces.push_back(surface);
      sources.push_back(&surface);
    }
  }
  std::vector<SurfacePatches> divided = DividedIntoPatches(surfaces, {}, kMaxProbes, 0);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Side side;
    side.surface = sources[i];
    std::size_t count = side.surface->positions.size();
    if (divided[i].count > 0) {
      side.groups = std::make_shared<const SurfacePatches>(std::move(divided[i]));
      count = side.groups->count;
    }
    side.first_corners =
        std::make_shared<const std::vector<std::uint32_t>>(FirstCorners(*side.surface));
    AddSide(side, count);
    if (side.surface->closed) continue;
    side.back = true;
    AddSide(side, count);
  }
}

void BodyProbes::AddSide(Side side, std::size_t probes) {
  side.first_probe = probes_.size();
  Probe probe;
  probe.side = static_cast<std::uint32_t>(sides_.size());
  probes_.insert(probes_.end(), probes, probe);
  sides_.push_back(std::move(side));
}

Surroundings::Coarse BodyProbes::CoarseTriangles(std::size_t drawn) const {
  const Side& side = sides_[drawn];
  Surroundings::Coarse coarse;
  if (!side.groups || side.surface->indices.size() <= 3 * kMaxFineTriangles) return coarse;
  const SurfacePatches& groups = *side.groups;
  const std::vector<Float3>& positions = side.surface->positions;
  std::uint32_t first = 0;
  for (const std::uint32_t last : groups.member_ends) {
    const std::span<const std::uint32_t> members =
        std::span(groups.members).subspan(first, last - first);
    first = last;
    Vec3 mean;
    for (const std::uint32_t v : members) {
      mean = mean + WideVector(positions[v]) * (1.0 / static_cast<double>(members.size()));
    }
    coarse.vertices.push_back(*std::ranges::min_element(
        members, {}, [&](std::uint32_t v) { return Norm(WideVector(positions[v]) - mean); }));
  }
  std::set<std::array<std::uint32_t, 3>> known;
  double length_m = 0.0;
  for (std::size_t i = 0; i + 2 < side.surface->indices.size(); i += 3) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = groups.patch_of[side.surface->indices[i + k]];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (!known.insert(corners).second) continue;
    coarse.indices.insert(coarse.indices.end(), corners.begin(), corners.end());
    length_m += Norm(WideVector(positions[coarse.vertices[corners[0]]]) -
                     WideVector(positions[coarse.vertices[corners[1]]]));
  }
  if (known.empty()) return {};
  coarse.gap_m = length_m / static_cast<double>(known.size());
  return coarse;
}

void BodyProbes::Refresh(const Surroundings& surroundings, std::size_t probes) {
  const std::size_t count = std::min(probes, probes_.size());
  const std::size_t first = next_;
  ParallelFor((count + kProbesPerBlock - 1) / kProbesPerBlock, 0, [&](std::size_t block) {
    const std::size_t last = std::min(count, (block + 1) * kProbesPerBlock);
    for (std::size_t i = block * kProbesPerBlock; i < last; ++i) {
      Trace(surroundings, (first + i) % probes_.size());
    }
  });
  if (!probes_.empty()) next_ = (first + count) % probes_.size();
  FillBuried();
}

void BodyProbes::Forget() {
  for (Probe& probe : probes_) probe.rays = 0.0F;
}

void BodyProbes::StartFrom(const BodyProbes& others) {
  ParallelFor((probes_.size() + kProbesPerBlock - 1) / kProbesPerBlock, 0, [&](std::size_t block) {
    const std::size_t last = std::min(probes_.size(), (block + 1) * kProbesPerBlock);
    for (std::size_t i = block * kProbesPerBlock; i < last; ++i) {
      Probe& probe = probes_[i];
      const Side& side = sides_[probe.side];
      const std::size_t own = i - side.first_probe;
      std::size_t vertex = own;
      if (side.groups) {
        vertex = side.groups->members[own == 0 ? 0 : side.groups->member_ends[own - 1]];
      }
      const Vec3 place = WideVector(side.surface->positions[vertex]);
      const Vec3 normal = WideVector(side.surface->normals[vertex]) * (side.back ? -1.0 : 1.0);
      const Probe* nearest = nullptr;
      double least_m = 0.0;
      for (const Probe& other : others.probes_) {
        if (other.rays <= 0.0F || Dot(WideVector(other.normal), normal) < 0.0) continue;
        const double distance_m = Norm(WideVector(other.place) - place);
        if (nearest != nullptr && distance_m >= least_m) continue;
        nearest = &other;
        least_m = distance_m;
      }
      if (nearest == nullptr) continue;
      const std::uint32_t probe_side = probe.side;
      probe = *nearest;
      probe.side = probe_side;
      probe.rays = std::min(probe.rays, static_cast<float>(kRays));
    }
  });
}

void BodyProbes::Trace(const Surroundings& surroundings, std::size_t index) {
  Probe& probe = probes_[index];
  const Side& side = sides_[probe.side];
  const SurfaceMesh& surface = *side.surface;
  const auto own = static_cast<std::uint32_t>(index - side.first_probe);
  std::span<const std::uint32_t> members(&own, 1);
  if (side.groups) {
    const std::uint32_t begin = own == 0 ? 0 : side.groups->member_ends[own - 1];
    members = std::span(side.groups->members).subspan(begin, side.groups->member_ends[own] - begin);
  }
  Vec3 bent, place, mean_normal;
  Float3 reflected{}, sunlight{}, sky{};
  std::uint32_t open = 0, outside = 0;
  const RoundSamples samples(kRays, probe.round, Hash(static_cast<std::uint32_t>(index), 0));
  for (std::uint32_t i = 0; i < kRays; ++i) {
    const std::size_t at = i * members.size() / kRays;
    const std::uint32_t vertex = members[(at + probe.round) % members.size()];
    const Vec3 position = WideVector(surface.positions[vertex]);
    const Vec3 normal = WideVector(surface.normals[vertex]) * (side.back ? -1.0 : 1.0);
    Vec3 centre;
    const std::uint32_t* corners = &surface.indices[(*side.first_corners)[vertex]];
    for (int k = 0; k < 3; ++k) centre = centre + WideVector(surface.positions[corners[k]]);
    // The same members in each round, so that only movement moves the mean.
    const std::uint32_t still = members[at];
    place = place + WideVector(surface.positions[still]);
    mean_normal = mean_normal + WideVector(surface.normals[still]) * (side.back ? -1.0 : 1.0);
    const Vec3 direction = CosineDirection(TangentFrame(normal), samples[i]);
    const SeenAlongRay seen =
        surroundings.Look(GatherOrigin({position, normal, {}}, centre * (1.0 / 3.0)), direction);
    if (seen.what == SeenAlongRay::What::kInside) continue;
    ++outside;
    if (seen.what == SeenAlongRay::What::kSky) {
      ++open;
      bent = bent + direction;
      AddTo(seen.radiance, std::numbers::pi_v<float>, &sky);
    } else {
      AddTo(seen.radiance, std::numbers::pi_v<float>, &reflected);
      AddTo(seen.sunlight, std::numbers::pi_v<float>, &sunlight);
    }
  }
  ++probe.round;
  if (outside == 0) return;
  const float share = 1.0F / static_cast<float>(outside);
  place = place * (1.0 / kRays);
  const Vec3 normal = mean_normal * (1.0 / kRays);
  const double moved_m = Norm(place - WideVector(probe.place));
  const double turned = Norm(normal - WideVector(probe.normal));
  const float most = moved_m < kRest_m && turned < kRestTurn ? kMaxRaysAtRest
                     : moved_m < kFar_m && turned < kFarTurn ? kMaxRaysMoving
                                                             : 2.0F * kRays;
  const float old_rays = std::min(probe.rays, most - kRays);
  probe.rays = old_rays + kRays;
  const float weight = static_cast<float>(kRays) / probe.rays;
  probe.open += weight * (static_cast<float>(open) * share - probe.open);
  const auto narrow = [](Vec3 v, double scale) {
    return Float3{static_cast<float>(v.x * scale), static_cast<float>(v.y * scale),
                  static_cast<float>(v.z * scale)};
  };
  Blend(narrow(bent, share), weight, &probe.bent);
  for (Float3* light : {&reflected, &sunlight, &sky}) {
    for (float& value : *light) value *= share;
  }
  Blend(reflected, weight, &probe.reflected);
  Blend(sunlight, weight, &probe.sunlight);
  Blend(sky, weight, &probe.sky);
  probe.place = narrow(place, 1.0);
  probe.normal = narrow(normal, 1.0);
}

/// Probes that lie inside of a body have the light of the one before them, which is near.
void BodyProbes::FillBuried() {
  for (std::size_t i = 1; i < probes_.size(); ++i) {
    Probe& probe = probes_[i];
    const Probe& before = probes_[i - 1];
    if (probe.rays > 0.0F || before.side != probe.side) continue;
    probe.bent = before.bent;
    probe.open = before.open;
    probe.reflected = before.reflected;
    probe.sunlight = before.sunlight;
    probe.sky = before.sky;
  }
}

BodyProbes::Received BodyProbes::LightOf(const SkyHarmonics& sky, const Probe& probe) {
  Vec3 bent = WideVector(probe.bent);
  if (Norm(bent) < 1e-3) bent = WideVector(probe.normal);
  if (Norm(bent) < 1e-3) bent = {0.0, 0.0, 1.0};
  bent = Normalized(bent);
  Received received{sky.Irradiance(bent, static_cast<double>(probe.open)), probe.sunlight};
  // The cone has little noise, the sum over many rays no error of its own.
  const float share =
      std::clamp((probe.rays - kMaxRaysMoving) / (kRaysOfSky - kMaxRaysMoving), 0.0F, 1.0F);
  Blend(probe.sky, share, &received.light);
  AddTo(probe.reflected, 1.0F, &received.light);
  return received;
}

BodyProbes::Received BodyProbes::LightAt(const Side& side, std::size_t vertex,
                                         std::span<const Received> probes) {
  if (!side.groups) return probes[side.first_probe + vertex];
  const SurfacePatches& groups = *side.groups;
  Received sum;
  const std::uint32_t begin = vertex == 0 ? 0 : groups.interpolation_ends[vertex - 1];
  for (std::uint32_t k = begin; k < groups.interpolation_ends[vertex]; ++k) {
    const auto& [patch, weight] = groups.interpolation_weights[k];
    AddTo(probes[side.first_probe + patch].light, weight, &sum.light);
    AddTo(probes[side.first_probe + patch].sunlight, weight, &sum.sunlight);
  }
  return sum;
}

void BodyProbes::Light(const SkyHarmonics& sky, std::span<LitMesh> drawn) const {
  std::vector<Received> received;
  received.reserve(probes_.size());
  for (const Probe& probe : probes_) received.push_back(LightOf(sky, probe));
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const Side& side = sides_[s];
    LitMesh& mesh = drawn[s];
    // The other side of a surface that light shines through has this light behind it.
    LitMesh* other = mesh.IsTranslucent() ? &drawn[side.back ? s - 1 : s + 1] : nullptr;
    const std::size_t count = mesh.positions.size();
    ParallelFor((count + kLitVerticesPerBlock - 1) / kLitVerticesPerBlock, 0,
                [&](std::size_t block) {
                  const std::size_t last = std::min(count, (block + 1) * kLitVerticesPerBlock);
                  for (std::size_t v = block * kLitVerticesPerBlock; v < last; ++v) {
                    const Received at = LightAt(side, v, received);
                    for (std::size_t c = 0; c < 3; ++c) {
                      const float light = std::max(at.light[c], 0.0F);
                      mesh.ambient_with[v][c] = light;
                      mesh.sunlight.reflected_with[v][c] = std::clamp(at.sunlight[c], 0.0F, light);
                    }
                    if (other == nullptr) continue;
                    other->ambient_without[v] = mesh.ambient_with[v];
                    other->sunlight.reflected_without[v] = mesh.sunlight.reflected_with[v];
                  }
                });
  }
}

}  // namespace pleinair::compositor
