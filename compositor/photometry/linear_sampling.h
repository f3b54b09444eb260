#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/camera_response.h"
#include "base/image.h"
#include "base/vector.h"

namespace pleinair::compositor {

/// Samples the linear light of a camera image, bilinear between the four pixels around `at`.
/// Returns nothing outside the image.
inline std::optional<std::array<double, 3>> SampleLinear(ImageView<const std::uint8_t> rgb, Vec2 at,
                                                         const CameraResponse& response) {
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  if (!(at.x >= 0.0 && at.y >= 0.0) || x + 1 >= rgb.width() || y + 1 >= rgb.height()) {
    return std::nullopt;
  }
  const double fx = at.x - x, fy = at.y - y;
  std::array<double, 3> value{};
  for (int c = 0; c < 3; ++c) {
    const auto& linear = response.Linear(c);
    const double top = linear[rgb(x, y, c)] * (1 - fx) + linear[rgb(x + 1, y, c)] * fx;
    const double bottom = linear[rgb(x, y + 1, c)] * (1 - fx) + linear[rgb(x + 1, y + 1, c)] * fx;
    value[c] = top * (1 - fy) + bottom * fy;
  }
  return value;
}

}  // namespace pleinair::compositor
