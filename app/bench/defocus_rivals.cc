#include "app/bench/defocus_rivals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "app/bench/bench_composer.h"

namespace pleinair::app {
namespace {

constexpr int kPlaces = PeeledBoards::kSide * PeeledBoards::kSide;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Light times coverage, and coverage.
using Layer = Image<float>;

void BlurAlong(const Layer& from, const std::vector<float>& kernel, bool is_row, Layer* to) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  for (int y = 0; y < from.height(); ++y) {
    for (int x = 0; x < from.width(); ++x) {
      std::array<float, 2> sum{};
      for (int i = -reach; i <= reach; ++i) {
        const int u = is_row ? std::clamp(x + i, 0, from.width() - 1) : x;
        const int v = is_row ? y : std::clamp(y + i, 0, from.height() - 1);
        const float weight = kernel[static_cast<std::size_t>(i + reach)];
        sum[0] += weight * from(u, v, 0);
        sum[1] += weight * from(u, v, 1);
      }
      (*to)(x, y, 0) = sum[0];
      (*to)(x, y, 1) = sum[1];
    }
  }
}

void Blur(double sigma_px, Layer* layer) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
  std::vector<float> kernel;
  kernel.reserve(static_cast<std::size_t>(2 * reach + 1));
  float sum = 0.0F;
  for (int i = -reach; i <= reach; ++i) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px))));
    sum += kernel.back();
  }
  for (float& weight : kernel) weight /= sum;
  Layer rows(layer->width(), layer->height(), 2);
  BlurAlong(*layer, kernel, true, &rows);
  BlurAlong(rows, kernel, false, layer);
}

/// Puts a layer over another.
void PutOver(const Layer& front, Layer* back) {
  for (int y = 0; y < front.height(); ++y) {
    for (int x = 0; x < front.width(); ++x) {
      const float left = 1.0F - front(x, y, 1);
      for (const int c : {0, 1}) (*back)(x, y, c) = front(x, y, c) + left * (*back)(x, y, c);
    }
  }
}

double DistanceOf(double circle_px, const compositor::ThinLens& lens, double fx) {
  const double dioptres = lens.focus_dioptres - circle_px / (fx * lens.aperture_m);
  return dioptres > 0.0 ? 1.0 / dioptres : kInfinity;
}

/// The boards by layers of depth, unblurred.
std::vector<Layer> SplitIntoLayers(const DefocusScene& scene, const PeeledBoards& seen,
                                   const MattingFunctions& matting, double fx) {
  std::vector<Layer> layers(static_cast<std::size_t>(matting.layers()),
                            Layer(seen.width(), seen.height(), 2));
  std::vector<double> distances(scene.boards.size());
  for (std::size_t i = 0; i < distances.size(); ++i) {
    distances[i] = DistanceOf(scene.boards[i].circle_px, scene.lens, fx);
  }
  for (int y = 0; y < seen.height(); ++y) {
    for (int x = 0; x < seen.width(); ++x) {
      for (int place = 0; place < kPlaces; ++place) {
        for (int k = 0; k < matting.layers(); ++k) {
          double light = 0.0, left = 1.0;
          for (int peel = 0; peel < PeeledBoards::kPeels; ++peel) {
            const int board = seen.Board(x, y, place, peel);
            if (board < 0) break;
            const auto i = static_cast<std::size_t>(board);
            const double weight = matting.Weight(k, distances[i], peel > 0);
            light += left * weight * scene.boards[i].light;
            left *= 1.0 - weight;
          }
          Layer& layer = layers[static_cast<std::size_t>(k)];
          layer(x, y, 0) += static_cast<float>(light / kPlaces);
          layer(x, y, 1) += static_cast<float>((1.0 - left) / kPlaces);
        }
      }
    }
  }
  return layers;
}

}  // namespace

PeeledBoards::PeeledBoards(const DefocusScene& scene, int width, int height)
    : board_(width, height, kPlaces * kPeels) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int place = 0; place < kPlaces; ++place) {
        const int row = place / kSide;
        const double u = x + (place % kSide + 0.5) / kSide, v = y + (row + 0.5) / kSide;
        int peel = 0;
        for (std::size_t i = 0; i < scene.boards.size() && peel < kPeels; ++i) {
          if (!scene.boards[i].Covers(u, v)) continue;
          board_(x, y, place * kPeels + peel++) = static_cast<std::int8_t>(i);
        }
        for (; peel < kPeels; ++peel) board_(x, y, place * kPeels + peel) = -1;
      }
    }
  }
}

double SigmaOfLayer(int n) {
  double variance = 0.0;
  for (int i = 1; i <= n; ++i) variance += i * i;
  return std::sqrt(variance);
}

MattingFunctions::MattingFunctions(double nearest_px, double farthest_px,
                                   const compositor::ThinLens& lens, double fx) {
  // Eq. 10: a circle of four standard deviations. Eq. 9: anchors at the mean of two layers'.
  const auto between = [](int n) { return 2.0 * (SigmaOfLayer(n) + SigmaOfLayer(n + 1)); };
  int before = 0, behind = 0;
  while (between(before) < -nearest_px) ++before;
  while (between(behind) < farthest_px) ++behind;
  focus_ = before;
  anchors_.reserve(static_cast<std::size_t>(before + behind) + 2);
  anchors_.push_back(0.0);
  for (int n = before - 1; n >= 0; --n) anchors_.push_back(DistanceOf(-between(n), lens, fx));
  for (int n = 0; n < behind; ++n) anchors_.push_back(DistanceOf(between(n), lens, fx));
  anchors_.push_back(kInfinity);
}

double MattingFunctions::Weight(int layer, double distance_m, bool is_peeled) const {
  const auto at = [&](int i) {
    if (i < 0) return 0.0;
    return i < static_cast<int>(anchors_.size()) ? anchors_[static_cast<std::size_t>(i)]
                                                 : kInfinity;
  };
  const double before = at(layer - 1), begin = at(layer), end = at(layer + 1),
               after = at(layer + 2);
  if (distance_m >= begin && distance_m <= end) return 1.0;
  if (distance_m > before && distance_m < begin) return (distance_m - before) / (begin - before);
  if (is_peeled || !(distance_m > end && distance_m < after)) return 0.0;
  return std::isfinite(after) ? (after - distance_m) / (after - end) : 0.0;
}

GaussianLayers DrawGaussianLayers(const DefocusScene& scene, const PeeledBoards& seen,
                                  bool in_cascade) {
  const auto [near, far] = std::ranges::minmax_element(scene.boards, {}, &BenchBoard::circle_px);
  const double fx = BenchCamera(seen.width(), seen.height()).fx;
  const MattingFunctions matting(near->circle_px, far->circle_px, scene.lens, fx);
  std::vector<Layer> layers = SplitIntoLayers(scene, seen, matting, fx);
  const int focus = matting.focus(), last = matting.layers() - 1;
  if (!in_cascade) {
    for (int k = 0; k <= last; ++k) {
      if (k != focus) Blur(SigmaOfLayer(std::abs(k - focus)), &layers[static_cast<std::size_t>(k)]);
    }
  }
  Layer front(seen.width(), seen.height(), 2), back(seen.width(), seen.height(), 2);
  for (int k = 0; k < focus; ++k) {  // Each next layer comes under those before.
    Layer under = layers[static_cast<std::size_t>(k)];
    PutOver(front, &under);
    front = std::move(under);
    if (in_cascade) Blur(focus - k, &front);
  }
  for (int k = last; k > focus; --k) {
    PutOver(layers[static_cast<std::size_t>(k)], &back);
    if (in_cascade) Blur(k - focus, &back);
  }
  PutOver(layers[static_cast<std::size_t>(focus)], &back);
  PutOver(front, &back);
  GaussianLayers drawn{Image<float>(seen.width(), seen.height()), matting.layers()};
  for (int y = 0; y < seen.height(); ++y) {
    for (int x = 0; x < seen.width(); ++x) drawn.light(x, y) = back(x, y, 0);
  }
  return drawn;
}

Image<float> DrawGathered(const DefocusScene& scene, const PeeledBoards& seen) {
  const int width = seen.width(), height = seen.height();
  Image<float> light(width, height), circle(width, height), gathered(width, height);
  const double behind_px =
      scene.lens.focus_dioptres * BenchCamera(width, height).fx * scene.lens.aperture_m;
  double largest_px = behind_px;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int place = 0; place < kPlaces; ++place) {
        const int board = seen.Board(x, y, place, 0);
        if (board >= 0) {
          light(x, y) += scene.boards[static_cast<std::size_t>(board)].light / kPlaces;
        }
      }
      const int middle = seen.Board(x, y, kPlaces / 2 + PeeledBoards::kSide / 2, 0);
      const double d =
          middle >= 0 ? scene.boards[static_cast<std::size_t>(middle)].circle_px : behind_px;
      circle(x, y) = static_cast<float>(d);
      largest_px = std::max(largest_px, std::fabs(d));
    }
  }
  const int reach = static_cast<int>(std::ceil(0.5 * largest_px)) + 1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0.0, weights = 0.0;
      for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u) {
          const bool is_farther = circle(u, v) > circle(x, y);
          const double own = std::fabs(circle(u, v)), here = std::fabs(circle(x, y));
          const double radius = 0.5 * (is_farther ? std::min(own, here) : own);
          const double covered = std::clamp(radius - std::hypot(u - x, v - y) + 0.5, 0.0, 1.0);
          const double weight = covered / std::max(1.0, std::numbers::pi * radius * radius);
          sum += weight * light(u, v);
          weights += weight;
        }
      }
      gathered(x, y) = static_cast<float>(weights > 0.0 ? sum / weights : light(x, y));
    }
  }
  return gathered;
}

}  // namespace pleinair::app
