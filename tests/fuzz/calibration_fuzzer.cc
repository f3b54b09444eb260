#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "devices/calibration/calibration.h"

// Any bytes give a valid lens or an error, never a crash.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto camera = pleinair::devices::ParseCalibration(
      {reinterpret_cast<const char*>(data), size}, "calibration");
  if (!camera) {
    if (camera.error().what.empty()) std::abort();
    return 0;
  }
  if (camera->width < 1 || camera->height < 1 || !(camera->fx > 0.0) || !(camera->fy > 0.0) ||
      !std::isfinite(camera->cx) || !std::isfinite(camera->cy)) {
    std::abort();
  }
  for (const double coefficient : camera->distortion) {
    if (!std::isfinite(coefficient)) std::abort();
  }
  return 0;
}
