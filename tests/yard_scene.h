#pragma once

#include <cmath>

#include "scene/scene_description.h"
#include "scene/sun_over_place.h"
#include "tests/compositor/photometry/photographed_yard.h"

namespace pleinair::tests {

/// Scene description of a photographed yard on a clear day. The heading puts the sun `off_deg` off
/// the yard's true sun. Its elevation is about that at 13:50 in September.
inline scene::SceneDescription YardScene(const compositor::testing::PhotographedYard& yard,
                                         double off_deg, UtcTime time) {
  scene::SceneDescription scene;
  scene.place_time.latitude_deg = 50.0;
  scene.cloudiness = scene::Cloudiness::kClear;
  const Vec3 sun = scene::SunOver(scene.place_time, time).ToSun().xyz, seen = yard.ToSun();
  scene.marker.heading =
      Radians(std::atan2(seen.y, seen.x) - std::atan2(sun.y, sun.x)) + FromDegrees(off_deg);
  return scene;
}

}  // namespace pleinair::tests
