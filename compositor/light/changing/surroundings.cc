#include "compositor/light/changing/surroundings.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "compositor/light/gather_origin.h"

namespace pleinair::compositor {
namespace {

Vec3 WidenedVector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

/// A value of the corners of a triangle, where a ray hit it.
std::array<float, 3> AtHit(const std::vector<std::array<float, 3>>& values,
                           const std::array<std::uint32_t, 3>& corners, const RayHit& hit) {
  if (values.empty()) return {};
  const auto &a = values[corners[0]], &b = values[corners[1]], &c = values[corners[2]];
  const float w = 1.0F - hit.u - hit.v;
  return {w * a[0] + hit.u * b[0] + hit.v * c[0], w * a[1] + hit.u * b[1] + hit.v * c[1],
          w * a[2] + hit.u * b[2] + hit.v * c[2]};
}

}  // namespace

std::vector<std::array<float, 3>> Surroundings::Surface::Positions() const {
  if (coarse.vertices.empty()) return front->positions;
  std::vector<std::array<float, 3>> positions;
  positions.reserve(coarse.vertices.size());
  for (const std::uint32_t vertex : coarse.vertices) positions.push_back(front->positions[vertex]);
  return positions;
}

void Surroundings::SetDaylight(const sky::SkyModel& day, const Mat3& marker_from_world) {
  sky_.emplace(day, marker_from_world, kLandAlbedo);
  to_sun_ = marker_from_world * day.ToSun().xyz;
  sun_lux_ = day.SunNormalIrradiance();
}

Result<std::unique_ptr<RayScene>> Surroundings::RaysOf(std::span<const Surface> surfaces) {
  std::vector<RayMesh> meshes;
  meshes.reserve(surfaces.size());
  for (const Surface& surface : surfaces) {
    meshes.push_back(
        {surface.Positions(),
         surface.coarse.vertices.empty() ? surface.front->indices : surface.coarse.indices, false});
  }
  return RayScene::Create(meshes, "scene");
}

Result<void> Surroundings::SetStill(std::vector<Surface> surfaces) {
  PLEINAIR_ASSIGN_OR_RETURN(still_rays_, RaysOf(surfaces));
  still_ = std::move(surfaces);
  return {};
}

Result<void> Surroundings::SetBodies(std::vector<Surface> surfaces) {
  PLEINAIR_ASSIGN_OR_RETURN(body_rays_, RaysOf(surfaces));
  bodies_ = std::move(surfaces);
  gap_m_ = 0.0;
  for (const Surface& body : bodies_) gap_m_ = std::max(gap_m_, body.coarse.gap_m);
  return {};
}

void Surroundings::MoveBodies() {
  std::vector<std::vector<std::array<float, 3>>> positions;
  positions.reserve(bodies_.size());
  for (const Surface& body : bodies_) positions.push_back(body.Positions());
  body_rays_->SetPositions(positions);
}

LinearRgb Surroundings::UnshadedSun(const Surface& surface, const RayHit& hit, Vec3 origin,
                                    Vec3 direction, Vec3* point) const {
  const std::size_t first = 3 * std::size_t{hit.triangle};
  const auto& positions = surface.front->positions;
  const auto corner = [&](std::size_t k) { return WidenedVector(positions[surface.Corner(k)]); };
  const Vec3 a = corner(first);
  Vec3 normal = Normalized(Cross(corner(first + 1) - a, corner(first + 2) - a));
  if (hit.back) normal = -normal;
  *point = origin + direction * hit.distance_m + normal * kRayOffset_m;
  return sun_lux_ * std::max(0.0, Dot(normal, to_sun_));
}

std::array<float, 3> Surroundings::ShadedSunlight(Vec3 origin, Vec3 direction) const {
  RayHit hit, body;
  Vec3 point;
  if (!still_rays_->Intersect(RayTargets::kEverything, origin, direction, &hit)) return {};
  const Surface& surface = still_[hit.mesh];
  if (hit.back && surface.back == nullptr) return {};
  const LinearRgb sun = UnshadedSun(surface, hit, origin, direction, &point);
  if (Luminance(sun) <= 0.0 || !IsShadedByBodies(point) ||
      still_rays_->Occluded(RayTargets::kEverything, point, to_sun_) ||
      (SeesBody(origin, direction, &body) && body.distance_m < hit.distance_m)) {
    return {};
  }
  const auto& [r, g, b] = surface.albedo;
  const LinearRgb radiance = sun * LinearRgb{r, g, b} * std::numbers::inv_pi;
  return {static_cast<float>(radiance.r), static_cast<float>(radiance.g),
          static_cast<float>(radiance.b)};
}

void Surroundings::AddLightOf(const Surface& surface, const RayHit& hit, Vec3 origin,
                              Vec3 direction, const std::array<float, 3>& albedo,
                              SeenAlongRay* seen) const {
  const LitMesh& side = hit.back ? *surface.back : *surface.front;
  const std::size_t first = 3 * std::size_t{hit.triangle};
  const std::array<std::uint32_t, 3> corners{surface.Corner(first), surface.Corner(first + 1),
                                             surface.Corner(first + 2)};
  const std::array<float, 3> ambient = AtHit(side.ambient_with, corners, hit);
  const std::array<float, 3> reflected = AtHit(side.sunlight.reflected_with, corners, hit);
  Vec3 point;
  LinearRgb sun = UnshadedSun(surface, hit, origin, direction, &point);
  if (Luminance(sun) > 0.0 &&
      (IsShadedByBodies(point) || still_rays_->Occluded(RayTargets::kEverything, point, to_sun_))) {
    sun = {};
  }
  const std::array<double, 3> sun_of{sun.r, sun.g, sun.b};
  for (std::size_t c = 0; c < 3; ++c) {
    const float share = albedo[c] * std::numbers::inv_pi_v<float>;
    const auto direct = static_cast<float>(sun_of[c]);
    seen->radiance[c] += share * (ambient[c] + direct);
    seen->sunlight[c] += share * (reflected[c] + direct);
  }
}

SeenAlongRay Surroundings::LightFrom(const Surface& surface, const RayHit& hit, Vec3 origin,
                                     Vec3 direction, SeenAlongRay::What what) const {
  if (hit.back && surface.back == nullptr) return {SeenAlongRay::What::kInside, {}, {}};
  SeenAlongRay seen{what, {}, {}};
  AddLightOf(surface, hit, origin, direction, surface.albedo, &seen);
  if (surface.back != nullptr && surface.transmittance != std::array<float, 3>{}) {
    RayHit other = hit;
    other.back = !hit.back;
    AddLightOf(surface, other, origin, direction, surface.transmittance, &seen);
  }
  return seen;
}

bool Surroundings::SeesBody(Vec3 origin, Vec3 direction, RayHit* hit) const {
  if (!body_rays_->Intersect(RayTargets::kEverything, origin + direction * gap_m_, direction,
                             hit)) {
    return false;
  }
  hit->distance_m += gap_m_;
  return true;
}

SeenAlongRay Surroundings::Look(Vec3 origin, Vec3 direction) const {
  RayHit body, still;
  const bool sees_body = body_rays_->Intersect(RayTargets::kEverything, origin, direction, &body);
  const bool sees_still =
      still_rays_->Intersect(RayTargets::kEverything, origin, direction, &still);
  if (sees_body && (!sees_still || body.distance_m < still.distance_m)) {
    return LightFrom(bodies_[body.mesh], body, origin, direction, SeenAlongRay::What::kBody);
  }
  if (sees_still) {
    return LightFrom(still_[still.mesh], still, origin, direction, SeenAlongRay::What::kStill);
  }
  if (sky_->SineElevation(direction) >= 0.0) {
    return {SeenAlongRay::What::kSky, sky_->Radiance(direction), {}};
  }
  return {SeenAlongRay::What::kLand, sky_->Radiance(direction), sky_->sunlight_from_land()};
}

std::optional<SeenAlongRay> Surroundings::LookAtBodies(Vec3 origin, Vec3 direction) const {
  RayHit body, still;
  if (!SeesBody(origin, direction, &body)) return {};
  if (still_rays_->Intersect(RayTargets::kEverything, origin, direction, &still) &&
      still.distance_m < body.distance_m) {
    return {};
  }
  return LightFrom(bodies_[body.mesh], body, origin, direction, SeenAlongRay::What::kBody);
}

}  // namespace pleinair::compositor
