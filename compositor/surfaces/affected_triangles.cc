#include "compositor/surfaces/affected_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

constexpr float kSameSun = 1e-3F;  // Radians: 1/5 solar radius, 1/4 minute of motion.

}  // namespace

AffectedTriangles::AffectedTriangles(const LitMesh& phantom) : triangles_(phantom.indices) {
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

void AffectedTriangles::SetLight(const LitMesh& phantom, const LightMix& mix) {
  const std::size_t count = phantom.ambient_with.size();
  ambient_.changes.clear();
  ambient_.with.clear();
  ambient_.without.clear();
  ambient_.changes.reserve(count);
  ambient_.with.reserve(count);
  ambient_.without.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [r, g, b] = phantom.AmbientWith(i, mix);
    const auto [r0, g0, b0] = phantom.AmbientWithout(i, mix);
    const glm::vec3 with(r, g, b), without(r0, g0, b0);
    ambient_.with.push_back(with);
    ambient_.without.push_back(without);
    ambient_.changes.push_back(
        glm::any(glm::greaterThan(glm::abs(with - without), kNoticeable * without)));
  }
  sun_visibility_.by_triangle = phantom.sunlight.by_triangle;
  const auto& [x, y, z] = phantom.sunlight.to_sun;
  sun_visibility_.to_sun = {x, y, z};
}

AffectedTriangles::Sorted AffectedTriangles::ChangeOf(const SunWindow& window,
                                                      const SunFootprint& objects,
                                                      const DrawReductions& reductions,
                                                      std::size_t first_index) const {
  bool sky_changes = false, sunlit = false;
  glm::vec2 low(1e30F), high(-1e30F);
  for (std::size_t k = first_index; k < first_index + 3; ++k) {
    const std::uint32_t vertex = triangles_[k];
    sky_changes = sky_changes || ambient_.changes[vertex];
    sunlit = sunlit || glm::dot(normals_[vertex], window.to_sun) > 0.0F;
    const glm::vec2 at = window.At(positions_[vertex]);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const bool inside = high.x > 0.0F && high.y > 0.0F && low.x < window.side && low.y < window.side;
  if (sunlit && inside && objects.Touches(low, high)) return {kSun, false};
  if (!sky_changes && reductions.affected_triangles) return {kNothing, false};
  // A sun that has moved casts other shadows than those of the computed visibility.
  const bool known = reductions.sun_visibility && !sun_visibility_.by_triangle.empty() &&
                     glm::distance(window.to_sun, sun_visibility_.to_sun) < kSameSun;
  const SunVisibility reach =
      known ? sun_visibility_.by_triangle[first_index / 3] : SunVisibility::kSome;
  if (!sunlit || reach == SunVisibility::kNone) return {kLinearSky, false};
  return reach == SunVisibility::kAll ? Sorted{kLinearSky, true} : Sorted{kSunlitSky, false};
}

std::optional<LinearShadowRatio> AffectedTriangles::LinearRatioOf(
    std::size_t first_index, const glm::vec3& to_sun, const glm::vec3& sun_normal_lux) const {
  std::array<glm::vec3, 3> corners_m{}, with{}, without{}, ratios{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = triangles_[first_index + k];
    corners_m[k] = positions_[vertex];
    const glm::vec3 sun = std::max(glm::dot(normals_[vertex], to_sun), 0.0F) * sun_normal_lux;
    with[k] = ambient_.with[vertex] + sun;
    without[k] = ambient_.without[vertex] + sun;
    ratios[k] = LinearShadowRatio::Between(with[k], without[k], glm::vec3(0.0F));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (!LinearShadowRatio::IsLinear({with[k], with[next]}, {without[k], without[next]})) {
      return std::nullopt;
    }
  }
  return LinearShadowRatio::Of(corners_m, ratios);
}

void AffectedTriangles::Sort(const SunWindow& window, const SunFootprint& objects,
                             const glm::vec3& sun_normal_lux, const DrawReductions& reductions) {
  for (auto& kind : kinds_) kind.clear();
  linear_ratios_.clear();
  linear_corners_.clear();
  for (std::size_t i = 0; i < triangles_.size(); i += 3) {
    auto [change, in_sun] = ChangeOf(window, objects, reductions, i);
    if (change == kLinearSky) {
      std::optional<LinearShadowRatio> linear_ratios;
      if (reductions.linear_shadow_ratio) {
        linear_ratios = LinearRatioOf(i, window.to_sun, in_sun ? sun_normal_lux : glm::vec3(0.0F));
      }
      if (linear_ratios && reductions.affected_triangles && linear_ratios->IsOne(kNoticeable)) {
        change = kNothing;
      } else if (linear_ratios) {
        linear_ratios_.push_back(*linear_ratios);
        linear_corners_.push_back({triangles_[i], triangles_[i + 1], triangles_[i + 2]});
      } else {
        change = kSunlitSky;
      }
    }
    auto& kind = kinds_[change];
    kind.insert(kind.end(), triangles_.begin() + static_cast<std::ptrdiff_t>(i),
                triangles_.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  indices_.clear();
  for (std::size_t kind = 0; kind < kChanges; ++kind) {
    indices_.insert(indices_.end(), kinds_[kind].begin(), kinds_[kind].end());
    ends_[kind] = static_cast<int>(indices_.size());
  }
}

float AffectedTriangles::MaxLinearChangeFarFrom(const glm::vec3& eye_m) const {
  float maximum = 0.0F;
  for (std::size_t i = 0; i < linear_ratios_.size(); ++i) {
    const glm::vec4& range = linear_ratios_[i].range;
    const float change = std::max(std::abs(1.0F - range.x), std::abs(1.0F - range.y));
    for (const std::uint32_t corner : linear_corners_[i]) {
      maximum = std::max(maximum, change * glm::distance(positions_[corner], eye_m));
    }
  }
  return maximum;
}

}  // namespace pleinair::compositor
