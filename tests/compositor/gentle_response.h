#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "base/camera_response.h"

namespace pleinair::compositor::testing {

/// A camera that compresses light much less than sRGB, differently per channel: light is the pixel
/// value to the power of 1.3, 1.5 and 1.7.
inline CameraResponse GentleResponse() {
  std::vector<double> encoded;
  std::array<std::vector<double>, 3> light;
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i) {
    encoded.push_back(static_cast<double>(i) / kSteps);
    for (const int c : {0, 1, 2}) light[c].push_back(std::pow(encoded.back(), 1.3 + 0.2 * c));
  }
  return *CameraResponse::FromSamples(encoded, light);
}

}  // namespace pleinair::compositor::testing
