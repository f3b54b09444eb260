#pragma once

#include "app/live/live_session.h"

namespace pleinair::tests {

constexpr int kSmallWidth = 160, kSmallHeight = 120;

/// Options of a session with a small camera, near a marker and without objects.
inline app::LiveOptions SmallCameraOptions() {
  app::LiveOptions options;
  options.camera.width = kSmallWidth;
  options.camera.height = kSmallHeight;
  options.camera.fx = options.camera.fy = 200.0;
  options.camera.cx = 79.5;
  options.camera.cy = 59.5;
  options.scene.marker.family = "tag36h11";
  options.scene.marker.size_m = 0.2;
  options.scene.place_time.latitude_deg = 50.0;
  return options;
}

}  // namespace pleinair::tests
