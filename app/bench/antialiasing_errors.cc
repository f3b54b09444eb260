#include "app/bench/antialiasing_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/srgb.h"

namespace pleinair::app {
namespace {

constexpr double kEdgeCoverage = 0.01;
constexpr double kShadowStep = 0.02;

double LightAt(const RgbImage& image, int x, int y) {
  const auto& linear = LinearFromSrgb8();
  return (linear[image(x, y, 0)] + linear[image(x, y, 1)] + linear[image(x, y, 2)]) / 3.0;
}

/// Range of light, and the largest coverage, over the 3 × 3 pixels around one.
struct Surroundings {
  double low = 1.0, high = 0.0, coverage = 0.0;
};

Surroundings Around(const RgbImage& truth, const RgbImage& coverage, int x, int y) {
  Surroundings around;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, truth.height() - 1); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, truth.width() - 1); ++i) {
      const double light = LightAt(truth, i, j);
      around.low = std::min(around.low, light);
      around.high = std::max(around.high, light);
      around.coverage = std::max(around.coverage, LightAt(coverage, i, j));
    }
  }
  return around;
}

PixelClass ClassOf(const RgbImage& truth, const RgbImage& coverage, int x, int y) {
  const double covered = LightAt(coverage, x, y);
  if (covered > 1.0 - kEdgeCoverage) return PixelClass::kInside;
  if (covered > kEdgeCoverage) return PixelClass::kSilhouette;
  const Surroundings around = Around(truth, coverage, x, y);
  if (around.coverage > 0.0 || around.high - around.low < kShadowStep) {
    return PixelClass::kUnaffected;
  }
  return PixelClass::kShadow;
}

}  // namespace

Image<unsigned char> ClassifyPixels(const RgbImage& truth, const RgbImage& coverage) {
  Image<unsigned char> classes(truth.width(), truth.height(), 1);
  for (int y = 0; y < truth.height(); ++y) {
    for (int x = 0; x < truth.width(); ++x) {
      classes(x, y) = static_cast<unsigned char>(ClassOf(truth, coverage, x, y));
    }
  }
  return classes;
}

AntialiasingErrors CompareToTruth(const RgbImage& image, const RgbImage& truth,
                                  const Image<unsigned char>& classes) {
  std::array<double, 4> squares{}, counts{};
  AntialiasingErrors errors;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double difference = std::abs(LightAt(image, x, y) - LightAt(truth, x, y));
      squares[classes(x, y)] += difference * difference;
      counts[classes(x, y)] += 1.0;
      if (classes(x, y) != 0) errors.worst = std::max(errors.worst, difference);
    }
  }
  const auto rms = [&](PixelClass pixels) {
    const auto i = static_cast<std::size_t>(pixels);
    return std::sqrt(squares[i] / std::max(counts[i], 1.0));
  };
  errors.silhouette_rmse = rms(PixelClass::kSilhouette);
  errors.shadow_rmse = rms(PixelClass::kShadow);
  errors.inside_rmse = rms(PixelClass::kInside);
  errors.rmse = std::sqrt((squares[1] + squares[2] + squares[3]) /
                          std::max(counts[1] + counts[2] + counts[3], 1.0));
  return errors;
}

double ShimmerOf(std::span<const RgbImage> frames, const Image<unsigned char>& classes) {
  double squares = 0.0, count = 0.0;
  for (std::size_t frame = 1; frame < frames.size(); ++frame) {
    for (int y = 0; y < classes.height(); ++y) {
      for (int x = 0; x < classes.width(); ++x) {
        const auto pixel = static_cast<PixelClass>(classes(x, y));
        if (pixel != PixelClass::kSilhouette && pixel != PixelClass::kShadow) continue;
        const double change = LightAt(frames[frame], x, y) - LightAt(frames[frame - 1], x, y);
        squares += change * change;
        count += 1.0;
      }
    }
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

}  // namespace pleinair::app
