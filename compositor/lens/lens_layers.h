#pragma once

#include <algorithm>
#include <cmath>

namespace pleinair::compositor {

/// Layers of depth, from near to far, that a lens blurs apart from one another. Within a layer the
/// circles of confusion differ by a pixel up to circles of 8 pixels, and by a quarter beyond.
inline constexpr int kLensLayers = 44;

/// Layers that differ by less are blurred alike: what they show side by side remains complete.
inline constexpr int kLayersApart = 2;

/// Layer of a circle of confusion, SignedCircle_px(), pixels.
inline int LayerOf(double signed_circle_px) {
  constexpr double kEven_px = 8.0;
  const double circle = std::fabs(signed_circle_px);
  const double place =
      circle <= kEven_px ? circle : kEven_px + std::log(circle / kEven_px) / std::log(1.25);
  constexpr int kInFocus = kLensLayers / 2;
  // To the nearest layer: half a layer is added before the fraction is cut.
  const int layer = static_cast<int>(kInFocus + 0.5 + std::copysign(place, signed_circle_px));
  return std::clamp(layer, 0, kLensLayers - 1);
}

}  // namespace pleinair::compositor
