#include "accuracy/point_spread.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pleinair::accuracy {
namespace {

/// One pixel that contributes to another.
struct Tap {
  int dx, dy;
  float weight;
};

int Mirrored(int at, int size) {
  if (size == 1) return 0;
  const int period = 2 * size - 2;
  at = ((at % period) + period) % period;
  return at < size ? at : period - at;
}

/// The image with `rim` mirrored pixels around it.
Image<float> WithRim(const Image<float>& light, int rim) {
  Image<float> wide(light.width() + 2 * rim, light.height() + 2 * rim);
  for (int y = 0; y < wide.height(); ++y) {
    const int from_y = Mirrored(y - rim, light.height());
    for (int x = 0; x < wide.width(); ++x) {
      wide(x, y) = light(Mirrored(x - rim, light.width()), from_y);
    }
  }
  return wide;
}

Image<float> Convolved(const Image<float>& light, const std::vector<Tap>& taps) {
  int rim = 0;
  for (const Tap& tap : taps) rim = std::max({rim, std::abs(tap.dx), std::abs(tap.dy)});
  const Image<float> wide = WithRim(light, rim);
  Image<float> blurred(light.width(), light.height());
  for (int y = 0; y < light.height(); ++y) {
    float* to = &blurred(0, y);
    for (const Tap& tap : taps) {
      const float* from = &wide(rim + tap.dx, y + rim + tap.dy);
      for (int x = 0; x < light.width(); ++x) to[x] += tap.weight * from[x];
    }
  }
  return blurred;
}

void Normalize(std::vector<Tap>* taps) {
  double sum = 0.0;
  for (const Tap& tap : *taps) sum += tap.weight;
  for (Tap& tap : *taps) tap.weight = static_cast<float>(tap.weight / sum);
}

}  // namespace

Image<float> GaussianBlurred(const Image<float>& light, double sigma_px) {
  const int radius = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<Tap> across, down;
  for (int i = -radius; i <= radius; ++i) {
    const auto weight = static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    across.push_back({i, 0, weight});
    down.push_back({0, i, weight});
  }
  Normalize(&across);
  Normalize(&down);
  return Convolved(Convolved(light, across), down);
}

Image<float> DiscBlurred(const Image<float>& light, double radius_px) {
  constexpr int kSamples = 8;  // Along a pixel's side.
  const int reach = static_cast<int>(std::ceil(radius_px)) + 1;
  std::vector<Tap> taps;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      int inside = 0;
      for (int j = 0; j < kSamples; ++j) {
        for (int i = 0; i < kSamples; ++i) {
          const double x = dx + (i + 0.5) / kSamples - 0.5, y = dy + (j + 0.5) / kSamples - 0.5;
          inside += x * x + y * y <= radius_px * radius_px;
        }
      }
      if (inside > 0) taps.push_back({dx, dy, static_cast<float>(inside)});
    }
  }
  Normalize(&taps);
  return Convolved(light, taps);
}

Image<float> StreakBlurred(const Image<float>& light, double length_px, double angle) {
  constexpr double kStepsPerPixel = 16.0;
  const int reach = static_cast<int>(std::ceil(0.5 * length_px)) + 1;
  const int side = 2 * reach + 1;
  std::vector<double> kernel(static_cast<std::size_t>(side) * side);
  const int steps = std::max(8, static_cast<int>(length_px * kStepsPerPixel));
  for (int step = 0; step < steps; ++step) {
    const double along = ((step + 0.5) / steps - 0.5) * length_px;
    const double x = reach + along * std::cos(angle), y = reach + along * std::sin(angle);
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const double share_x = x - column, share_y = y - row;
    double* at = &kernel[static_cast<std::size_t>(row) * side + column];
    at[0] += (1 - share_x) * (1 - share_y);
    at[1] += share_x * (1 - share_y);
    at[side] += (1 - share_x) * share_y;
    at[side + 1] += share_x * share_y;
  }
  std::vector<Tap> taps;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double weight = kernel[static_cast<std::size_t>(row) * side + column];
      if (weight > 0.0) taps.push_back({column - reach, row - reach, static_cast<float>(weight)});
    }
  }
  Normalize(&taps);
  return Convolved(light, taps);
}

}  // namespace pleinair::accuracy
