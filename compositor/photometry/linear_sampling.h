#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "base/camera_image.h"
#include "base/camera_response.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// Samples the linear light of a camera image, bilinear between the four pixels around `at`.
/// Returns nothing outside the image.
inline std::optional<std::array<double, 3>> SampleLinear(CameraImageView image, Vec2 at,
                                                         const CameraResponse& response) {
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  if (!(at.x >= 0.0 && at.y >= 0.0) || x + 1 >= image.width() || y + 1 >= image.height()) {
    return std::nullopt;
  }
  const double fx = at.x - x, fy = at.y - y;
  std::array<double, 3> value{};
  for (int c = 0; c < 3; ++c) {
    const auto light = [&](int column, int row) -> double {
      if (!image.deep().empty()) return response.LinearOf16(image.deep()(column, row, c), c);
      return response.Linear(c)[image.rgb()(column, row, c)];
    };
    const double top = light(x, y) * (1 - fx) + light(x + 1, y) * fx;
    const double bottom = light(x, y + 1) * (1 - fx) + light(x + 1, y + 1) * fx;
    value[c] = top * (1 - fy) + bottom * fy;
  }
  return value;
}

}  // namespace pleinair::compositor
