#include <cmath>
#include <cstdio>

#include "base/units.h"
#include "base/utc_time.h"
#include "compositor/models/model.h"
#include "devices/calibration/calibration.h"
#include "shadows/splits.h"
#include "sky/sun/sun_position.h"
#include "tracker/tracker.h"

// Uses something of every library, so that each must link; 0 where the sun stands where it should.
int main() {
  using namespace pleinair;
  const auto no_camera = devices::ReadCalibration("/nonexistent/camera.yaml");
  const auto no_model = compositor::LoadModel("/nonexistent/model.obj");
  const auto no_tracker = tracker::Tracker::Create(CameraModel{}, {});
  if (no_camera || no_model || no_tracker) return 1;
  const sky::Observer courtyard{FromDegrees(50.0875), FromDegrees(14.4213), Metres(220)};
  const auto sun = sky::ComputeSunPosition(courtyard, *UtcTime::Parse("2025-09-14T11:05:00Z"));
  std::printf("%.3f\n", ToDegrees(sun.elevation));
  return std::abs(ToDegrees(sun.elevation) - 43.101) < 0.01 ? 0 : 1;
}
