#pragma once

#include <algorithm>
#include <cmath>

namespace pleinair::compositor {

/// Layers of depth, from near to far, that a lens blurs apart from one another. Within a layer the
/// circles of confusion differ by a pixel up to circles of 8 pixels, and by a quarter beyond.
inline constexpr int kLensLayers = 44;

/// Layers that differ by less are blurred alike: what they show side by side remains complete.
inline constexpr int kLayersApart = 2;

/// The layer of what is in focus.
inline constexpr int kLayerInFocus = kLensLayers / 2;

/// Circles of confusion up to which layers differ by a pixel, and the ratio of those beyond.
inline constexpr double kEvenLayers_px = 8.0, kLayerRatio = 1.25;

/// Layer of a circle of confusion, SignedCircle_px(), pixels.
inline int LayerOf(double signed_circle_px) {
  const double circle = std::fabs(signed_circle_px);
  const double place =
      circle <= kEvenLayers_px
          ? circle
          : kEvenLayers_px + std::log(circle / kEvenLayers_px) / std::log(kLayerRatio);
  // To the nearest layer: half a layer is added before the fraction is cut.
  const int layer = static_cast<int>(kLayerInFocus + 0.5 + std::copysign(place, signed_circle_px));
  return std::clamp(layer, 0, kLensLayers - 1);
}

/// The signed circle at which a layer begins, pixels.
inline double FirstCircle_px(int layer) {
  const double place = layer - 0.5 - kLayerInFocus, size = std::fabs(place);
  const double circle =
      size <= kEvenLayers_px ? size : kEvenLayers_px * std::pow(kLayerRatio, size - kEvenLayers_px);
  return std::copysign(circle, place);
}

}  // namespace pleinair::compositor
