#pragma once

#include <array>

#include "base/vector.h"

namespace pleinair::compositor {

/// Strength of sun and sky in a frame, relative to the light that was solved: a passing cloud
/// changes both. Per channel of linear Rec.709.
struct LightMix {
  LinearRgb sun{1.0, 1.0, 1.0};  ///< Direct and reflected sunlight.
  LinearRgb sky{1.0, 1.0, 1.0};  ///< Skylight, direct and reflected.

  /// Light without direct sunlight. `ambient` is the solved light, `reflected` its part that is
  /// reflected sunlight, same unit. For a mix of 1 the result is `ambient` bit by bit.
  std::array<float, 3> Ambient(const std::array<float, 3>& ambient,
                               const std::array<float, 3>& reflected) const {
    const auto mix = [](float all, float of_sun, double sun_mix, double sky_mix) {
      return all * static_cast<float>(sky_mix) + of_sun * static_cast<float>(sun_mix - sky_mix);
    };
    return {mix(ambient[0], reflected[0], sun.r, sky.r),
            mix(ambient[1], reflected[1], sun.g, sky.g),
            mix(ambient[2], reflected[2], sun.b, sky.b)};
  }

  bool operator==(const LightMix&) const = default;
};

}  // namespace pleinair::compositor
