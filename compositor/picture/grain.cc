#include "compositor/picture/grain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "compositor/light/sampling.h"

namespace pleinair::compositor {

Image<float> MakeGrain(int side, double neighbour_correlation) {
  constexpr int kChannels = 4;
  // White noise filtered by (a, 1, a) in both directions has the correlation 2 a / (1 + 2 a²).
  const double rho = std::clamp(neighbour_correlation, 0.0, 0.7);
  const double a = rho > 0.0 ? (1.0 - std::sqrt(1.0 - 2.0 * rho * rho)) / (2.0 * rho) : 0.0;
  const double norm = 1.0 / (1.0 + 2.0 * a * a);
  Image<float> white(side, side, kChannels), grain(side, side, kChannels);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < kChannels; c += 2) {
        // Box & Muller 1958.
        const std::uint32_t seed =
            Hash(Hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                 static_cast<std::uint32_t>(c));
        const double radius = std::sqrt(-2.0 * std::log(1.0 - UnitFromHash(seed)));
        const double angle = 2.0 * std::numbers::pi * UnitFromHash(Hash(seed, 1));
        white(x, y, c) = static_cast<float>(radius * std::cos(angle));
        white(x, y, c + 1) = static_cast<float>(radius * std::sin(angle));
      }
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < kChannels; ++c) {
        double sum = 0.0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const double weight = (dx == 0 ? 1.0 : a) * (dy == 0 ? 1.0 : a);
            sum += weight * white((x + dx + side) % side, (y + dy + side) % side, c);
          }
        }
        grain(x, y, c) = static_cast<float>(sum * norm);
      }
    }
  }
  return grain;
}

}  // namespace pleinair::compositor
