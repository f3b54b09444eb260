#include "compositor/picture/edge_profile.h"

#include <array>
#include <cmath>
#include <numbers>

namespace pleinair::compositor {
namespace {

EdgeProfile GaussianEdge(double distance_px, double blur_px) {
  const double t = distance_px / blur_px;
  const double slope = std::exp(-t * t / 2) / std::sqrt(2 * std::numbers::pi) / blur_px;
  return {0.5 * std::erfc(-t / std::numbers::sqrt2), slope, -slope * t};
}

/// Gauss–Chebyshev rule of the second kind: weights of chords of the disc of diameter 2.
constexpr int kNodes = 16;
struct Chords {
  std::array<double, kNodes> at{}, weight{};
};

Chords MakeChords() {
  Chords chords;
  for (int k = 1; k <= kNodes; ++k) {
    const double angle = k * std::numbers::pi / (kNodes + 1), sine = std::sin(angle);
    chords.at[k - 1] = std::cos(angle);
    chords.weight[k - 1] = 2.0 / (kNodes + 1) * sine * sine;
  }
  return chords;
}

}  // namespace

EdgeProfile DefocusedEdge(double distance_px, double circle_px, double blur_px) {
  constexpr double kMinCircle_px = 0.05;
  if (circle_px < kMinCircle_px) return GaussianEdge(distance_px, blur_px);
  static const Chords kChords = MakeChords();
  EdgeProfile sum;
  for (int k = 0; k < kNodes; ++k) {
    const double weight = kChords.weight[k];
    const EdgeProfile edge = GaussianEdge(distance_px - 0.5 * circle_px * kChords.at[k], blur_px);
    sum.value += weight * edge.value;
    sum.slope += weight * edge.slope;
    sum.by_blur += weight * edge.by_blur;
  }
  return sum;
}

EdgeProfile MovedEdge(double distance_px, double circle_px, double streak_px, double blur_px) {
  constexpr double kMinStreak_px = 0.05, kStep_px = 0.5;
  if (streak_px < kMinStreak_px) return DefocusedEdge(distance_px, circle_px, blur_px);
  const int parts = static_cast<int>(std::ceil(streak_px / kStep_px)) + 1;
  EdgeProfile mean;
  for (int i = 0; i < parts; ++i) {
    const double at = distance_px + streak_px * ((i + 0.5) / parts - 0.5);
    const EdgeProfile edge = DefocusedEdge(at, circle_px, blur_px);
    mean.value += edge.value / parts;
    mean.slope += edge.slope / parts;
    mean.by_blur += edge.by_blur / parts;
  }
  return mean;
}

}  // namespace pleinair::compositor
