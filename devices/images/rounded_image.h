#pragma once

#include <cstddef>
#include <cstdint>

#include "base/camera_image.h"

namespace pleinair::devices {

/// An image rounded to 8 bits.
inline RgbImage RoundedTo8Bits(const DeepImage& deep) {
  constexpr int kPerCode = 257;  // 65,535 / 255.
  RgbImage rgb(deep.width(), deep.height(), deep.channels());
  for (std::size_t i = 0; i < deep.size(); ++i) {
    rgb.data()[i] = static_cast<std::uint8_t>((deep.data()[i] + kPerCode / 2) / kPerCode);
  }
  return rgb;
}

}  // namespace pleinair::devices
