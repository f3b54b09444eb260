#include "compositor/picture/blur_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/vector.h"

namespace pleinair::compositor {
namespace {

constexpr int kStripesPerSide = 48;
constexpr double kNarrowestBandPx = 5.0;
constexpr double kMaxEdgeDistance_px =
    14.0;  // Distance from an edge within which a blur of a third of it is fully visible.
constexpr int kMinPixels = 40;    // Per edge of a side.
constexpr double kBadFit = 0.12;  // RMS of a side's fit, relative to the step from black to white.
constexpr double kMinBlur_px = 0.2;

double Gauss(double t) { return std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi); }
double GaussIntegral(double t) { return 0.5 * std::erfc(-t / std::numbers::sqrt2); }

/// A pixel near an edge: distance across the edge, towards the white, and brightness.
struct EdgePixel {
  double distance_px, value;
};

/// An edge's brightness, and its derivatives by distance and by blur.
struct EdgeProfile {
  double value = 0.0, slope = 0.0, by_blur = 0.0;
};

EdgeProfile GaussianEdge(double distance_px, double blur_px) {
  const double t = distance_px / blur_px, slope = Gauss(t) / blur_px;
  return {GaussIntegral(t), slope, -slope * t};
}

/// The edge after a disc of this diameter and a Gaussian. The disc's chords are integrated by the
/// Gauss–Chebyshev rule of the second kind.
EdgeProfile DefocusedEdge(double distance_px, double circle_px, double blur_px) {
  constexpr double kMinCircle_px = 0.05;
  if (circle_px < kMinCircle_px) return GaussianEdge(distance_px, blur_px);
  constexpr int kNodes = 16;
  EdgeProfile sum;
  for (int k = 1; k <= kNodes; ++k) {
    const double angle = k * std::numbers::pi / (kNodes + 1);
    const double weight = 2.0 / (kNodes + 1) * std::sin(angle) * std::sin(angle);
    const EdgeProfile edge = GaussianEdge(distance_px - 0.5 * circle_px * std::cos(angle), blur_px);
    sum.value += weight * edge.value;
    sum.slope += weight * edge.slope;
    sum.by_blur += weight * edge.by_blur;
  }
  return sum;
}

/// Least-squares fit of black + (white − black) Φ((d − shift) / blur) by Gauss–Newton with damped
/// steps (Levenberg 1944). With a circle of confusion, Φ is blurred by its disc. Returns nothing if
/// the pixels are no such edge.
std::optional<double> FitBlur(const std::vector<EdgePixel>& pixels, double circle_px) {
  double shift = 0.0, blur = 0.7, damping = 1e-3;
  const auto cost_of = [&](double s, double b) {
    double cost = 0.0;
    for (const EdgePixel& p : pixels) {
      const double r = p.value - DefocusedEdge(p.distance_px - s, circle_px, b).value;
      cost += r * r;
    }
    return cost;
  };
  double cost = cost_of(shift, blur);
  for (int iteration = 0; iteration < 30; ++iteration) {
    double a00 = 0.0, a01 = 0.0, a11 = 0.0, g0 = 0.0, g1 = 0.0;
    for (const EdgePixel& p : pixels) {
      const EdgeProfile edge = DefocusedEdge(p.distance_px - shift, circle_px, blur);
      const double residual = p.value - edge.value;
      const double by_shift = -edge.slope, by_blur = edge.by_blur;
      a00 += by_shift * by_shift;
      a01 += by_shift * by_blur;
      a11 += by_blur * by_blur;
      g0 += by_shift * residual;
      g1 += by_blur * residual;
    }
    const double b00 = a00 * (1 + damping), b11 = a11 * (1 + damping);
    const double determinant = b00 * b11 - a01 * a01;
    if (!(determinant > 0.0)) return std::nullopt;
    const double new_shift = shift + (b11 * g0 - a01 * g1) / determinant;
    const double new_blur = std::max(kMinBlur_px, blur + (b00 * g1 - a01 * g0) / determinant);
    const double new_cost = cost_of(new_shift, new_blur);
    if (new_cost > cost) {
      damping = damping * 10 + 1e-6;
      if (damping > 1e6) break;
      continue;
    }
    const bool still = std::fabs(new_blur - blur) + std::fabs(new_shift - shift) < 1e-4;
    shift = new_shift;
    blur = new_blur;
    cost = new_cost;
    damping *= 0.3;
    if (still) break;
  }
  if (std::sqrt(cost / static_cast<double>(pixels.size())) > kBadFit) return std::nullopt;
  return blur;
}

/// Adds the pixels of a strip across a side, with brightness 0 in the black and 1 in the white.
/// `along`: −1 at one end of the side, 1 at the other.
void AddStripe(const MarkerInImage& marker, int side, double along,
               std::vector<EdgePixel>* pixels) {
  const double c = std::array{1.0, 0.0, -1.0, 0.0}[side];
  const double s = std::array{0.0, 1.0, 0.0, -1.0}[side];
  const double half = marker.marker().size_m / 2;
  const double band_m = std::min(marker.white_m(), marker.marker().black_band_m);
  const auto at = [&](double x, double y) {
    return marker.PixelOf({c * x - s * y, s * x + c * y});
  };
  const auto edge = at(along * half, half), beside = at((along + 0.01) * half, half);
  const auto outer = at(along * half, half + band_m / 2);
  const auto inner = at(along * half, half - band_m / 2);
  if (!edge || !beside || !outer || !inner) return;
  const Vec2 step = *beside - *edge;
  if (!(Norm(step) > 0.0)) return;
  const Vec2 tangent = step * (1.0 / Norm(step));
  Vec2 normal{-tangent.y, tangent.x};
  const Vec2 outwards = *outer - *inner;
  if (normal.x * outwards.x + normal.y * outwards.y < 0.0) normal = normal * -1.0;
  const double band_px = std::fabs(normal.x * outwards.x + normal.y * outwards.y);
  if (band_px < kNarrowestBandPx) return;
  const double reach = std::min(0.9 * band_px, kMaxEdgeDistance_px);
  // The levels on either side, far from the edge, then every pixel with its centre in a strip one
  // pixel wide.
  double white = 0.0, black = 0.0;
  int whites = 0, blacks = 0;
  std::vector<EdgePixel> strip;
  const int x0 = static_cast<int>(std::lround(edge->x)),
            y0 = static_cast<int>(std::lround(edge->y));
  const int r = static_cast<int>(std::ceil(reach)) + 1;
  for (int y = y0 - r; y <= y0 + r; ++y) {
    for (int x = x0 - r; x <= x0 + r; ++x) {
      if (!marker.IsInside(x, y)) continue;
      const Vec2 offset = Vec2{static_cast<double>(x), static_cast<double>(y)} - *edge;
      if (std::fabs(offset.x * tangent.x + offset.y * tangent.y) > 0.5) continue;
      const double distance = offset.x * normal.x + offset.y * normal.y;
      if (std::fabs(distance) > reach) continue;
      if (marker.IsClipped(x, y, 2)) return;
      const double value = marker.Grey(x, y);
      strip.push_back({distance, value});
      if (distance > 0.7 * reach) {
        white += value;
        ++whites;
      }
      if (distance < -0.7 * reach) {
        black += value;
        ++blacks;
      }
    }
  }
  if (whites == 0 || blacks == 0) return;
  white /= whites;
  black /= blacks;
  // Paper reflects twenty times as much as ink. A hand or a shadow edge has a lower contrast.
  if (white < 2.0 * black || white - black < 0.02) return;
  for (const EdgePixel& p : strip) {
    pixels->push_back({p.distance_px, (p.value - black) / (white - black)});
  }
}

}  // namespace

std::vector<double> EstimateEdgeBlur(const MarkerInImage& marker,
                                     const std::array<double, 4>& circles_px) {
  std::vector<double> blurs;
  for (int side = 0; side < 4; ++side) {
    std::vector<EdgePixel> pixels;
    for (int i = 0; i < kStripesPerSide; ++i) {
      // Away from the corners, where two edges meet.
      AddStripe(marker, side, 0.8 * (2.0 * (i + 0.5) / kStripesPerSide - 1.0), &pixels);
    }
    if (static_cast<int>(pixels.size()) < kMinPixels) continue;
    if (const auto blur = FitBlur(pixels, circles_px[side])) blurs.push_back(*blur);
  }
  return blurs;
}

}  // namespace pleinair::compositor
