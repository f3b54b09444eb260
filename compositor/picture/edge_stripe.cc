#include "compositor/picture/edge_stripe.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pleinair::compositor {
namespace {

constexpr double kNarrowestBandPx = 5.0;
constexpr double kLevels = 0.7;  // Share of the reach beyond which a stripe's levels are read.

/// Places of a stripe: on the edge, and in the middle of white and black beside it.
bool PlaceStripe(const MarkerInImage& marker, int side, double along, const StripeReach& reach,
                 EdgeStripe* stripe) {
  const double c = std::array{1.0, 0.0, -1.0, 0.0}[side];
  const double s = std::array{0.0, 1.0, 0.0, -1.0}[side];
  const double half = marker.marker().size_m / 2;
  const double band_m = std::min(marker.white_m(), marker.marker().black_band_m);
  const auto turned = [&](double x, double y) { return Vec2{c * x - s * y, s * x + c * y}; };
  stripe->on_marker = turned(along * half, half);
  const auto edge = marker.PixelOf(stripe->on_marker);
  const auto beside = marker.PixelOf(turned((along + 0.01) * half, half));
  const auto outer = marker.PixelOf(turned(along * half, half + band_m / 2));
  const auto inner = marker.PixelOf(turned(along * half, half - band_m / 2));
  if (!edge || !beside || !outer || !inner) return false;
  const Vec2 step = *beside - *edge;
  if (!(Norm(step) > 0.0)) return false;
  const Vec2 tangent = step * (1.0 / Norm(step));
  Vec2 normal{-tangent.y, tangent.x};
  const Vec2 outwards = *outer - *inner;
  const double band_px = normal.x * outwards.x + normal.y * outwards.y;
  if (band_px < 0.0) normal = normal * -1.0;
  if (std::fabs(band_px) < kNarrowestBandPx) return false;
  stripe->edge_px = *edge;
  stripe->outward = normal;
  stripe->reach_px = std::min(reach.share * std::fabs(band_px), reach.largest_px);
  return true;
}

}  // namespace

bool ReadEdgeStripe(const MarkerInImage& marker, int side, double along, const StripeReach& reach,
                    EdgeStripe* stripe) {
  stripe->pixels.clear();
  if (!PlaceStripe(marker, side, along, reach, stripe)) return false;
  const Vec2 edge = stripe->edge_px, normal = stripe->outward, tangent{normal.y, -normal.x};
  // The levels on either side, far from the edge, then every pixel with its centre in the strip.
  double white = 0.0, black = 0.0;
  int whites = 0, blacks = 0;
  const int x0 = static_cast<int>(std::lround(edge.x)), y0 = static_cast<int>(std::lround(edge.y));
  const int r = static_cast<int>(std::ceil(stripe->reach_px)) + 1;
  for (int y = y0 - r; y <= y0 + r; ++y) {
    for (int x = x0 - r; x <= x0 + r; ++x) {
      if (!marker.IsInside(x, y)) continue;
      const Vec2 offset = Vec2{static_cast<double>(x), static_cast<double>(y)} - edge;
      if (std::fabs(offset.x * tangent.x + offset.y * tangent.y) > 0.5) continue;
      const double distance = offset.x * normal.x + offset.y * normal.y;
      if (std::fabs(distance) > stripe->reach_px) continue;
      if (marker.IsClipped(x, y, 2)) return false;
      const double value = marker.Grey(x, y);
      stripe->pixels.push_back({distance, value});
      if (distance > kLevels * stripe->reach_px) {
        white += value;
        ++whites;
      }
      if (distance < -kLevels * stripe->reach_px) {
        black += value;
        ++blacks;
      }
    }
  }
  if (whites == 0 || blacks == 0) return false;
  white /= whites;
  black /= blacks;
  // Paper reflects twenty times as much as ink. A hand or a shadow edge has a lower contrast.
  if (white < 2.0 * black || white - black < 0.02) return false;
  for (EdgePixel& pixel : stripe->pixels) pixel.value = (pixel.value - black) / (white - black);
  return true;
}

}  // namespace pleinair::compositor
