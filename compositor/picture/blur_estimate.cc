#include "compositor/picture/blur_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "compositor/picture/edge_profile.h"
#include "compositor/picture/edge_stripe.h"

namespace pleinair::compositor {
namespace {

constexpr int kStripesPerSide = 48;
constexpr int kMinPixels = 40;    // Per edge of a side.
constexpr double kBadFit = 0.12;  // RMS of a side's fit, relative to the step from black to white.
constexpr double kMinBlur_px = 0.2;

/// Least-squares fit of black + (white − black) Φ((d − shift) / blur) by Gauss–Newton with damped
/// steps (Levenberg 1944). With a circle of confusion, Φ is blurred by its disc, and with a
/// streak by its box. Returns nothing if
/// the pixels are no such edge.
std::optional<double> FitBlur(const std::vector<EdgePixel>& pixels, double circle_px,
                              double streak_px) {
  double shift = 0.0, blur = 0.7, damping = 1e-3;
  const auto cost_of = [&](double s, double b) {
    double cost = 0.0;
    for (const EdgePixel& p : pixels) {
      const double r = p.value - MovedEdge(p.distance_px - s, circle_px, streak_px, b).value;
      cost += r * r;
    }
    return cost;
  };
  double cost = cost_of(shift, blur);
  for (int iteration = 0; iteration < 30; ++iteration) {
    double a00 = 0.0, a01 = 0.0, a11 = 0.0, g0 = 0.0, g1 = 0.0;
    for (const EdgePixel& p : pixels) {
      const EdgeProfile edge = MovedEdge(p.distance_px - shift, circle_px, streak_px, blur);
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

}  // namespace

std::vector<double> EstimateEdgeBlur(const MarkerInImage& marker, const KnownSpread& known) {
  std::vector<double> blurs;
  EdgeStripe stripe;
  for (int side = 0; side < 4; ++side) {
    std::vector<EdgePixel> pixels;
    for (int i = 0; i < kStripesPerSide; ++i) {
      // Away from the corners, where two edges meet.
      const double along = 0.8 * (2.0 * (i + 0.5) / kStripesPerSide - 1.0);
      if (!ReadEdgeStripe(marker, side, along, {}, &stripe)) continue;
      pixels.insert(pixels.end(), stripe.pixels.begin(), stripe.pixels.end());
    }
    if (static_cast<int>(pixels.size()) < kMinPixels) continue;
    if (const auto blur = FitBlur(pixels, known.circles_px[side], known.streaks_px[side]))
      blurs.push_back(*blur);
  }
  return blurs;
}

}  // namespace pleinair::compositor
