#include "compositor/photometry/shade/ratio_from_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "base/quantile.h"
#include "compositor/light/scaled_sky.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMinPlaces = 8;
constexpr std::uint32_t kPaths = 384;
// Share of the places that are assumed to lie between full sun and none.
constexpr double kDeepShare = 0.5;
// Contrast below which the cause of a step is unknown.
constexpr double kMinStep = 0.25;
// Logarithmic uncertainty common to all places. Half-light on either side makes the sky look
// stronger beside the sun. The crown's occlusion of the sky makes it look weaker.
constexpr double kCommonDoubt = 0.25;

/// Sky radiance scale at which `contrast` is that between full sun and none. Not above 0 where even
/// a black sky would give less contrast.
double ScaleOf(double contrast, double sun, double sky, double reflected) {
  return (sun / std::expm1(contrast) - reflected) / sky;
}

/// Estimates the sky radiance scale from the depth of the shade at these places.
SunSkyRatio ReadPlaces(const PhantomRays& phantoms, const std::vector<ShadowCrossing>& crossings,
                       double shaded, const sky::SkyModel& daylight,
                       const Mat3& marker_from_world) {
  SunSkyRatio estimate;
  const Vec3 to_sun = marker_from_world * daylight.ToSun().xyz;
  // By plane, because ambient light is evaluated per plane.
  std::map<std::array<double, 3>, std::vector<std::size_t>> by_normal;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const Vec3 n = crossings[i].normal;
    by_normal[{n.x, n.y, n.z}].push_back(i);
  }
  const ScaledSky sky_alone(daylight, {1, 1, 1}, {});
  // Reflecting surfaces are shaded in the same proportion.
  const double sunlit = 1.0 - shaded;
  const ScaledSky sun_alone(daylight, {}, {sunlit, sunlit, sunlit});
  struct Place {
    LinearRgb log_scale;
    double depth = 0.0;
  };
  std::vector<Place> places;
  for (const auto& [n, members] : by_normal) {
    const Vec3 normal{n[0], n[1], n[2]};
    std::vector<Point<Marker>> points;
    points.reserve(members.size());
    for (const std::size_t i : members) points.push_back(crossings[i].middle);
    const auto sky = phantoms.Ambient(points, normal, sky_alone, marker_from_world, kPaths);
    const auto reflected = phantoms.Ambient(points, normal, sun_alone, marker_from_world, kPaths);
    const LinearRgb sun = daylight.SunNormalIrradiance() * std::max(0.0, Dot(normal, to_sun));
    for (std::size_t k = 0; k < members.size(); ++k) {
      const LinearRgb& contrast = crossings[members[k]].contrast;
      if (std::min({contrast.r, contrast.g, contrast.b}) < kMinStep) continue;
      const double r = ScaleOf(contrast.r, sun.r, sky[k].r, reflected[k].r);
      const double g = ScaleOf(contrast.g, sun.g, sky[k].g, reflected[k].g);
      const double b = ScaleOf(contrast.b, sun.b, sky[k].b, reflected[k].b);
      if (!(std::min({r, g, b}) > 0.0) || !std::isfinite(r + g + b)) continue;
      places.push_back({{std::log(r), std::log(g), std::log(b)}, g});
    }
  }
  estimate.edges = static_cast<int>(places.size());
  if (places.size() < kMinPlaces) return estimate;
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.depth < b.depth; });
  places.resize(static_cast<std::size_t>(kDeepShare * static_cast<double>(places.size())));
  const auto middle = [&](auto channel) {
    std::vector<double> values;
    values.reserve(places.size());
    for (const Place& place : places) values.push_back(channel(place.log_scale));
    return Quantile(values, 0.5);
  };
  const double green = middle([](LinearRgb c) { return c.g; });
  estimate.sun = SunSkyRatio::Sun::kShines;
  estimate.agreeing = static_cast<int>(places.size());
  estimate.sky_radiance_scale = {std::exp(middle([](LinearRgb c) { return c.r; })), std::exp(green),
                                 std::exp(middle([](LinearRgb c) { return c.b; }))};
  double square = 0.0;
  for (const Place& place : places) square += std::pow(place.log_scale.g - green, 2);
  const auto count = static_cast<double>(places.size());
  estimate.log_uncertainty = std::sqrt(square / count / count + kCommonDoubt * kCommonDoubt);
  return estimate;
}

}  // namespace

SunSkyRatio EstimateRatioFromShade(const PhantomRays& phantoms, const UnmodelledShadows& unmodelled,
                                   const sky::SkyModel& daylight, const Mat3& marker_from_world) {
  const SunSkyRatio estimate =
      ReadPlaces(phantoms, unmodelled.crossings, unmodelled.shaded, daylight, marker_from_world);
  if (estimate.sun == SunSkyRatio::Sun::kShines) return estimate;
  if (!unmodelled.IsWide() && !unmodelled.ShadesMarker()) return estimate;
  return ReadPlaces(phantoms, unmodelled.deepest, unmodelled.shaded, daylight, marker_from_world);
}

}  // namespace pleinair::compositor
