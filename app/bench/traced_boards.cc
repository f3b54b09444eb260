#include "app/bench/traced_boards.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/parallel_for.h"

namespace pleinair::app {
namespace {

constexpr int kRays = 4096;

/// Where a ray starts: on the stop, in diameters from its centre, and in the pixel.
struct RayPlaces {
  double stop_x, stop_y, x, y;
};

/// A digit-reversed number: the `index`-th of a Halton sequence.
double RadicalInverse(int index, int base) {
  double value = 0.0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * (index % base);
  return value;
}

std::vector<RayPlaces> Rays() {
  std::vector<RayPlaces> rays;
  rays.reserve(kRays);
  for (int i = 1; i <= kRays; ++i) {
    const double radius = 0.5 * std::sqrt(RadicalInverse(i, 2));
    const double angle = 2.0 * std::numbers::pi * RadicalInverse(i, 3);
    rays.push_back({radius * std::cos(angle), radius * std::sin(angle), RadicalInverse(i, 5),
                    RadicalInverse(i, 7)});
  }
  return rays;
}

/// Light of the nearest board that a ray meets; black behind them all.
float LightSeen(const DefocusScene& scene, double x, double y, const RayPlaces& ray) {
  for (const BenchBoard& board : scene.boards) {
    if (board.Covers(x + ray.x - board.circle_px * ray.stop_x,
                     y + ray.y - board.circle_px * ray.stop_y)) {
      return board.light;
    }
  }
  return 0.0F;
}

}  // namespace

Image<float> TraceBoards(const DefocusScene& scene, int width, int height) {
  const std::vector<RayPlaces> rays = Rays();
  Image<float> light(width, height);
  ParallelFor(static_cast<std::size_t>(height), 0, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (const RayPlaces& ray : rays) sum += LightSeen(scene, x, y, ray);
      light(x, y) = static_cast<float>(sum / kRays);
    }
  });
  return light;
}

}  // namespace pleinair::app
