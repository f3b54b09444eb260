#include "content/flow/line_integral_convolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "base/parallel_for.h"
#include "content/flow/field_probe.h"
#include "content/flow/grid_stencil.h"

namespace pleinair::content {
namespace {

constexpr int kMaxConvolutionSide = 16384;
constexpr int kMaxConvolutionLevels = 12;
constexpr std::size_t kRows = 8;  // That a thread takes at once.
constexpr double kPixelsPerGrain = 2.0;

/// White noise, 0…255: a hash of the place.
float NoiseOf(std::int64_t x, std::int64_t y) {
  // Finalizer of SplitMix64.
  auto bits = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(y);
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<float>((bits ^ (bits >> 31U)) >> 56U);
}

/// Noise between the middles of grains, by the cubic B-spline: without frequencies that
/// interpolation between pixels would lose, so that doubling keeps them.
float SmoothNoise(const Vec3& place, double grain_m) {
  const double x = place.x / grain_m, y = place.y / grain_m;
  const double column = std::floor(x), row = std::floor(y);
  const auto weights = [](double t) {
    const double rest = 1.0 - t;
    return std::array<double, 4>{
        rest * rest * rest / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
        (3.0 * rest * rest * rest - 6.0 * rest * rest + 4.0) / 6.0, t * t * t / 6.0};
  };
  const std::array<double, 4> wx = weights(x - column), wy = weights(y - row);
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      sum += wx[i] * wy[j] *
             static_cast<double>(NoiseOf(std::llround(column) + static_cast<std::int64_t>(i),
                                         std::llround(row) + static_cast<std::int64_t>(j)));
    }
  }
  return static_cast<float>(sum);
}

/// The pixels of a texture over a field.
struct Texture {
  int width = 0, height = 0;
  Vec3 low;
  double pixel_x_m = 1.0, pixel_y_m = 1.0, step_pixels = 1.0;

  Vec3 PlaceOf(double x, double y) const {
    return {low.x + (x + 0.5) * pixel_x_m, low.y + (height - y - 0.5) * pixel_y_m, low.z};
  }
  std::size_t Number(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// A step along the flow in pixels, by Runge and Kutta's method. Returns false where it leaves.
bool StepInPixels(const Texture& texture, FieldProbe* probe, Seconds time, double sign, Vec2* at) {
  const auto direction = [&](const Vec2& p, Vec2* d) {
    Vec3 v;
    if (probe->Sample(texture.PlaceOf(p.x, p.y), time, &v) == PointState::kNoFlow) return false;
    *d = {v.x / texture.pixel_x_m, -v.y / texture.pixel_y_m};
    const double norm = Norm(*d);
    if (!(norm > 0.0)) return false;
    *d = *d * (sign / norm);
    return true;
  };
  const double h = texture.step_pixels;
  Vec2 k1, k2, k3, k4;
  if (!direction(*at, &k1) || !direction(*at + k1 * (0.5 * h), &k2) ||
      !direction(*at + k2 * (0.5 * h), &k3) || !direction(*at + k3 * h, &k4)) {
    return false;
  }
  *at = *at + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
  return at->x >= 0.0 && at->y >= 0.0 && at->x <= texture.width - 1.0 &&
         at->y <= texture.height - 1.0;
}

/// What a path of a pixel gathered: its displacement, or not a number where it ended, the sum of
/// the noise and the number of its points.
struct PathSum {
  float dx = 0.0F, dy = 0.0F, sum = 0.0F, count = 0.0F;
};
using PathSums = std::vector<PathSum>;

/// Catmull-Rom interpolation. Where a pixel of the stencil ended, of the nearest pixel.
PathSum Interpolated(const Texture& texture, const PathSums& sums, double x, double y) {
  const int column = std::clamp(static_cast<int>(x), 0, texture.width - 2);
  const int row = std::clamp(static_cast<int>(y), 0, texture.height - 2);
  const AxisStencil sx = CatmullRomStencil(column, x - column, texture.width);
  const AxisStencil sy = CatmullRomStencil(row, y - row, texture.height);
  std::array<float, 4> total{};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const PathSum& each = sums[texture.Number(sx.node[i], sy.node[j])];
      const auto weight = static_cast<float>(sx.weight[i] * sy.weight[j]);
      total[0] += weight * each.dx;
      total[1] += weight * each.dy;
      total[2] += weight * each.sum;
      total[3] += weight * each.count;
    }
  }
  if (!std::isnan(total[0])) return {total[0], total[1], total[2], total[3]};
  return sums[texture.Number(column + (x - column > 0.5 ? 1 : 0), row + (y - row > 0.5 ? 1 : 0))];
}

template <typename Body>
void ForRows(const Texture& texture, int threads, const Body& body) {
  const auto rows = static_cast<std::size_t>(texture.height);
  ParallelFor((rows + kRows - 1) / kRows, threads, [&](std::size_t block) {
    const auto last = static_cast<int>(std::min(rows, (block + 1) * kRows));
    body(static_cast<int>(block * kRows), last);
  });
}

struct Canvas {
  Texture texture;
  PathSums noise;  // Of each pixel alone.
  std::unique_ptr<FieldProbe> probe;
};

/// The sums of all pixels, each begun with its noise. `add`: continues that of a pixel, with a
/// probe of its thread.
template <typename Add>
PathSums SumsOf(const Canvas& canvas, int threads, const Add& add) {
  const Texture& texture = canvas.texture;
  PathSums sums = canvas.noise;
  ForRows(texture, threads, [&](int first, int last) {
    const std::unique_ptr<FieldProbe> own = canvas.probe->Copy();
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < texture.width; ++x) {
        add(Vec2{1.0 * x, 1.0 * y}, own.get(), &sums[texture.Number(x, y)]);
      }
    }
  });
  return sums;
}

Result<Canvas> MakeCanvas(const VectorField& field, Seconds frozen_s,
                          const ConvolutionOptions& options) {
  const Box box = field.bounds();
  const bool fits = options.width >= 2 && options.height >= 2 &&
                    options.width <= kMaxConvolutionSide && options.height <= kMaxConvolutionSide &&
                    options.levels >= 0 && options.levels <= kMaxConvolutionLevels &&
                    options.step_pixels > 0.0;
  if (!fits || !(box.max.x > box.min.x) || !(box.max.y > box.min.y)) {
    return InputError("",
                      "a texture needs a field in the plane, 2 to 16384 pixels a side and at "
                      "most 12 levels",
                      "choose another size");
  }
  Canvas canvas;
  Texture& texture = canvas.texture;
  texture.width = options.width;
  texture.height = options.height;
  texture.low = box.min;
  texture.pixel_x_m = (box.max.x - box.min.x) / options.width;
  texture.pixel_y_m = (box.max.y - box.min.y) / options.height;
  texture.step_pixels = options.step_pixels;
  const double grain_m =
      options.grain_m > 0.0 ? options.grain_m : kPixelsPerGrain * texture.pixel_x_m;
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      canvas.noise.push_back({0.0F, 0.0F, SmoothNoise(texture.PlaceOf(x, y), grain_m), 1.0F});
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(canvas.probe, MakeFrozenProbe(field, frozen_s));
  return canvas;
}

/// The mean of both ways; the pixel itself is in each. Zero in walls.
Image<float> MeanOf(const Canvas& canvas, Seconds frozen_s, const PathSums& up,
                    const PathSums& down) {
  Image<float> image(canvas.texture.width, canvas.texture.height);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const std::size_t n = canvas.texture.Number(x, y);
      Vec3 ignored;
      const bool flows = canvas.probe->Sample(canvas.texture.PlaceOf(x, y), frozen_s, &ignored) ==
                         PointState::kFlow;
      const float sum = up[n].sum + down[n].sum - canvas.noise[n].sum;
      const float count = up[n].count + down[n].count - canvas.noise[n].count;
      image(x, y) = flows ? std::clamp(sum / count, 0.0F, 255.0F) : 0.0F;
    }
  }
  return image;
}

/// One way: 2^levels steps by doubling. The first has a single step.
PathSums SumByLevels(const Canvas& canvas, Seconds frozen_s, const ConvolutionOptions& options,
                     double sign) {
  const Texture& texture = canvas.texture;
  PathSums sums =
      SumsOf(canvas, options.threads, [&](const Vec2& from, FieldProbe* probe, PathSum* sum) {
        Vec2 at = from;
        const bool goes_on = StepInPixels(texture, probe, frozen_s, sign, &at);
        constexpr float kEnded = std::numeric_limits<float>::quiet_NaN();
        sum->dx = goes_on ? static_cast<float>(at.x - from.x) : kEnded;
        sum->dy = goes_on ? static_cast<float>(at.y - from.y) : kEnded;
      });
  PathSums twice(sums.size());
  for (int level = 0; level < options.levels; ++level) {
    ForRows(texture, options.threads, [&](int first, int last) {
      for (int y = first; y < last; ++y) {
        for (int x = 0; x < texture.width; ++x) {
          const PathSum& half = sums[texture.Number(x, y)];
          PathSum& whole = twice[texture.Number(x, y)];
          whole = half;
          if (std::isnan(half.dx)) continue;
          const PathSum rest = Interpolated(texture, sums, x + static_cast<double>(half.dx),
                                            y + static_cast<double>(half.dy));
          whole.dx += rest.dx;
          whole.dy += rest.dy;
          whole.sum += rest.sum;
          whole.count += rest.count;
        }
      }
    });
    std::swap(sums, twice);
  }
  return sums;
}

PathSums SumSerially(const Canvas& canvas, Seconds frozen_s, const ConvolutionOptions& options,
                     double sign) {
  return SumsOf(canvas, options.threads, [&](Vec2 at, FieldProbe* probe, PathSum* sum) {
    for (int n = 1; n < 1 << options.levels; ++n) {
      if (!StepInPixels(canvas.texture, probe, frozen_s, sign, &at)) break;
      sum->sum += Interpolated(canvas.texture, canvas.noise, at.x, at.y).sum;
      sum->count += 1.0F;
    }
  });
}

}  // namespace

Result<Image<float>> ConvolveByLevels(const VectorField& field, Seconds frozen_s,
                                      const ConvolutionOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const Canvas canvas, MakeCanvas(field, frozen_s, options));
  return MeanOf(canvas, frozen_s, SumByLevels(canvas, frozen_s, options, -1.0),
                SumByLevels(canvas, frozen_s, options, 1.0));
}

Result<Image<float>> ConvolveSerially(const VectorField& field, Seconds frozen_s,
                                      const ConvolutionOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const Canvas canvas, MakeCanvas(field, frozen_s, options));
  return MeanOf(canvas, frozen_s, SumSerially(canvas, frozen_s, options, -1.0),
                SumSerially(canvas, frozen_s, options, 1.0));
}

}  // namespace pleinair::content
