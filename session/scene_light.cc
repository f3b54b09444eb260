#include "session/scene_light.h"

#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"

namespace pleinair::session {
namespace {

// The sun moves its own width in about two minutes; the light among surfaces is made anew
// after half of that, the sun itself moves in every frame.
constexpr double kSunStep = 0.25 * kRadiansPerDegree;

std::vector<compositor::LitMesh> LightAmongSurfaces(const LightOrder& order,
                                                    const sky::SkyModel& daylight,
                                                    const Mat3& marker_from_world) {
  if (!order.coefficients) {
    const auto& sunlight = order.skies.sunlight;
    const bool holds = sunlight && sunlight->HoldsFor(marker_from_world * daylight.ToSun().xyz);
    return order.solver->SolveUnderTrees(daylight, marker_from_world,
                                         holds ? *sunlight : compositor::SeenSunlight{});
  }
  return order.solver->Relight(*order.coefficients, daylight, marker_from_world);
}

}  // namespace

SceneLight::SceneLight(const LightOrder& light_order)
    : order(light_order),
      marker_from_world(scene::MarkerFromWorld(order.marker)),
      sun(scene::SunOver(order.place, order.time)),
      model(order.skies.source->ForSun(sun.ToSun(), sun.distance_au)),
      daylight(*model, order.skies.scale, {1.0, 1.0, 1.0}),
      meshes(LightAmongSurfaces(order, daylight, marker_from_world)) {
  auto& sunlight = order.skies.sunlight;
  if (sunlight && !sunlight->HoldsFor(marker_from_world * model->ToSun().xyz)) {
    sunlight.reset();  // At another hour trees shade other places.
  }
  from_below = order.solver->RadianceFromBelow(daylight, marker_from_world,
                                               sunlight ? *sunlight : compositor::SeenSunlight{});
  if (order.print.size_m <= 0.0) return;
  meter.emplace(order.print, *order.solver, daylight, marker_from_world, order.response);
}

bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now) {
  return Norm(made_for.ToSun().xyz - now.ToSun().xyz) < kSunStep;
}

}  // namespace pleinair::session
