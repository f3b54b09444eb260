#include "session/baked_lighting.h"

#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"

namespace pleinair::session {
namespace {

// The sun moves by its own width in about two minutes. The indirect illumination is computed again
// after half of that; the sun itself moves in every frame.
constexpr double kSunStep = 0.25 * kRadiansPerDegree;

std::vector<compositor::LitMesh> LightAmongSurfaces(const LightingRequest& request,
                                                    const sky::SkyModel& daylight,
                                                    const Mat3& marker_from_world) {
  if (!request.coefficients) {
    const auto& sun_transmittance = request.skies.sun_transmittance;
    const bool holds =
        sun_transmittance && sun_transmittance->HoldsFor(marker_from_world * daylight.ToSun().xyz);
    return request.solver->SolveUnderTrees(
        daylight, marker_from_world,
        holds ? *sun_transmittance : compositor::SunTransmittanceMap{});
  }
  return request.solver->Relight(*request.coefficients, daylight, marker_from_world);
}

std::shared_ptr<const CloudedDay> CloudedDayOf(const LightingRequest& request,
                                               const sky::SunPosition& sun) {
  if (request.clouds.empty() || !request.clouds_rule) return nullptr;
  return std::make_shared<const CloudedDay>(ClearSkyOf(request, sun), request.skies.scale,
                                            request.clouds, request.CloudSeconds(request.time));
}

}  // namespace

double LightingRequest::CloudSeconds(UtcTime at) const {
  return 1e-9 *
         static_cast<double>(at.nanoseconds_since_1970() - place.start.nanoseconds_since_1970());
}

std::unique_ptr<sky::SkyModel> ClearSkyOf(const LightingRequest& request,
                                          const sky::SunPosition& sun) {
  return request.skies.source->ForSun(sun.ToSun(), sun.distance_au);
}

BakedLighting::BakedLighting(const LightingRequest& lighting_request)
    : request(lighting_request),
      marker_from_world(scene::MarkerFromWorld(request.marker)),
      sun(scene::SunOver(request.place, request.time)),
      clouded(CloudedDayOf(request, sun)),
      model(clouded ? clouded : std::shared_ptr<const sky::SkyModel>(ClearSkyOf(request, sun))),
      daylight(*model, clouded ? LinearRgb{1.0, 1.0, 1.0} : request.skies.scale, {1.0, 1.0, 1.0}),
      meshes(LightAmongSurfaces(request, daylight, marker_from_world)) {
  auto& sun_transmittance = request.skies.sun_transmittance;
  if (sun_transmittance && !sun_transmittance->HoldsFor(marker_from_world * model->ToSun().xyz)) {
    sun_transmittance.reset();  // At another hour trees shade other places.
  }
  from_below = request.solver->RadianceFromBelow(
      daylight, marker_from_world,
      sun_transmittance ? *sun_transmittance : compositor::SunTransmittanceMap{});
  if (!request.clouds.empty() && !request.clouds_rule) {
    mirrored = std::make_shared<const MirroredClouds>(
        daylight, CloudedDay(ClearSkyOf(request, sun), request.skies.scale, request.clouds,
                             request.CloudSeconds(request.time)));
  }
  if (request.marker_reflectance.size_m <= 0.0) return;
  meter.emplace(request.marker_reflectance, request.solver->phantoms(), daylight, marker_from_world,
                request.response);
}

bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now) {
  return Norm(made_for.ToSun().xyz - now.ToSun().xyz) < kSunStep;
}

}  // namespace pleinair::session
