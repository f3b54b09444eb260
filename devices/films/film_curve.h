#pragma once

#include "base/camera_response.h"

namespace pleinair::devices {

/// Curve from scene light to the 8-bit pixel values of a film's images.
enum class FilmCurve {
  kSrgb,     ///< IEC 61966-2-1. Also where the film states none, and after a conversion from HDR.
  kBt709,    ///< ITU-R BT.709-6, item 1.2; the same in BT.601-7 and, with 8 bits, in BT.2020-2.
  kGamma22,  ///< Power of 2.2 (ITU-R BT.470 System M).
  kGamma28,  ///< Power of 2.8 (ITU-R BT.470 System B, G).
};

/// The curve as the camera's response in linear light.
CameraResponse ResponseOf(FilmCurve curve);

}  // namespace pleinair::devices
