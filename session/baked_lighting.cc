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

}  // namespace

BakedLighting::BakedLighting(const LightingRequest& lighting_request)
    : request(lighting_request),
      marker_from_world(scene::MarkerFromWorld(request.marker)),
      sun(scene::SunOver(request.place, request.time)),
      model(request.skies.source->ForSun(sun.ToSun(), sun.distance_au)),
      daylight(*model, request.skies.scale, {1.0, 1.0, 1.0}),
      meshes(LightAmongSurfaces(request, daylight, marker_from_world)) {
  auto& sun_transmittance = request.skies.sun_transmittance;
  if (sun_transmittance && !sun_transmittance->HoldsFor(marker_from_world * model->ToSun().xyz)) {
    sun_transmittance.reset();  // At another hour trees shade other places.
  }
  from_below = request.solver->RadianceFromBelow(
      daylight, marker_from_world,
      sun_transmittance ? *sun_transmittance : compositor::SunTransmittanceMap{});
  if (request.marker_reflectance.size_m <= 0.0) return;
  meter.emplace(request.marker_reflectance, request.solver->phantoms(), daylight, marker_from_world,
                request.response);
}

bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now) {
  return Norm(made_for.ToSun().xyz - now.ToSun().xyz) < kSunStep;
}

}  // namespace pleinair::session
