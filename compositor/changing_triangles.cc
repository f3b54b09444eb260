#include "compositor/changing_triangles.h"

#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

constexpr float kSameSun = 1e-3F;  // Radians: a fifth of the sun's radius, a quarter of a minute.

}  // namespace

ChangingTriangles::ChangingTriangles(const LitMesh& phantom) : triangles_(phantom.indices) {
  const std::size_t count = phantom.positions.size();
  positions_.reserve(count);
  normals_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& p = phantom.positions[i];
    const auto& n = phantom.normals[i];
    positions_.emplace_back(p[0], p[1], p[2]);
    normals_.emplace_back(n[0], n[1], n[2]);
  }
  SetLight(phantom);
}

void ChangingTriangles::SetLight(const LitMesh& phantom) {
  sky_changes_.clear();
  sky_changes_.reserve(phantom.ambient_with.size());
  for (std::size_t i = 0; i < phantom.ambient_with.size(); ++i) {
    bool changes = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const float without = phantom.ambient_without[i][c];
      changes = changes || std::abs(phantom.ambient_with[i][c] - without) > kNoticeable * without;
    }
    sky_changes_.push_back(changes);
  }
  sun_reach_ = phantom.sun_reach;
  const auto& [x, y, z] = phantom.reached_to_sun;
  reached_to_sun_ = {x, y, z};
}

ChangingTriangles::Change ChangingTriangles::ChangeOf(const SunWindow& window,
                                                      const SunFootprint& objects,
                                                      std::size_t first_index) const {
  bool sky_changes = false, sunlit = false;
  glm::vec2 low(1e30F), high(-1e30F);
  for (std::size_t k = first_index; k < first_index + 3; ++k) {
    const std::uint32_t vertex = triangles_[k];
    sky_changes = sky_changes || sky_changes_[vertex];
    sunlit = sunlit || glm::dot(normals_[vertex], window.to_sun) > 0.0F;
    const glm::vec2 at = window.At(positions_[vertex]);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const bool inside = high.x > 0.0F && high.y > 0.0F && low.x < window.side && low.y < window.side;
  if (sunlit && inside && objects.Touches(low, high)) return kSun;
  if (!sky_changes) return kNothing;
  // A sun that has moved on casts other shadows than it did for the light.
  const bool known =
      !sun_reach_.empty() && glm::distance(window.to_sun, reached_to_sun_) < kSameSun;
  const SunReach reach = known ? sun_reach_[first_index / 3] : SunReach::kSome;
  if (!sunlit || reach == SunReach::kNone) return kSky;
  return reach == SunReach::kAll ? kOpenSky : kSunlitSky;
}

void ChangingTriangles::Sort(const SunWindow& window, const SunFootprint& objects) {
  for (auto& kind : kinds_) kind.clear();
  for (std::size_t i = 0; i < triangles_.size(); i += 3) {
    auto& kind = kinds_[ChangeOf(window, objects, i)];
    kind.insert(kind.end(), triangles_.begin() + static_cast<std::ptrdiff_t>(i),
                triangles_.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  indices_.clear();
  for (std::size_t kind = 0; kind < kChanges; ++kind) {
    indices_.insert(indices_.end(), kinds_[kind].begin(), kinds_[kind].end());
    ends_[kind] = static_cast<int>(indices_.size());
  }
}

}  // namespace pleinair::compositor
