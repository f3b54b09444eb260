#include "compositor/lens/disc_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace pleinair::compositor {
namespace {

constexpr double kFineUpTo_px = 8.0;
constexpr int kFinePerPixel = 8, kCoarsePerPixel = 4;
constexpr int kFineSteps = 64;  // Up to kFineUpTo_px.
constexpr int kSteps =
    kFineSteps + kCoarsePerPixel * static_cast<int>(DiscKernels::kMaxCircle_px - kFineUpTo_px);
constexpr int kParts = 10;        // The whole pixel, and parts by their sides.
constexpr int kRowsOfPixel = 16;  // Over which a row of pixels is averaged.
constexpr float kLeastRise = 1e-7F;

double CircleOf_px(int step) {
  const int steps = std::abs(step);
  const double circle =
      steps <= kFineSteps
          ? static_cast<double>(steps) / kFinePerPixel
          : kFineUpTo_px + static_cast<double>(steps - kFineSteps) / kCoarsePerPixel;
  return step < 0 ? -circle : circle;
}

struct Chord {
  double from = 0.0, to = 0.0;
};

/// Where the row at `y` cuts the stop's image of this circumscribed radius; negative: turned by
/// half a turn.
std::optional<Chord> ChordAt(const LensStop& stop, double radius, double y) {
  if (stop.blades == 0) {
    const double square = radius * radius - y * y;
    if (square <= 0.0) return std::nullopt;
    return Chord{-std::sqrt(square), std::sqrt(square)};
  }
  std::optional<Chord> chord;
  const auto corner = [&](int i) {
    const double angle = stop.rotation_rad + 2.0 * std::numbers::pi * i / stop.blades;
    return std::array{radius * std::cos(angle), radius * std::sin(angle)};
  };
  for (int i = 0; i < stop.blades; ++i) {
    const auto [ax, ay] = corner(i);
    const auto [bx, by] = corner(i + 1);
    if ((ay > y) == (by > y)) continue;
    const double x = ax + (bx - ax) * (y - ay) / (by - ay);
    chord = chord ? Chord{std::min(chord->from, x), std::max(chord->to, x)} : Chord{x, x};
  }
  return chord;
}

/// Weights over a square of pixels around the centre.
struct Weights {
  int reach = 0;
  std::vector<double> of_pixel;  // Row by row.
  double At(int x, int y) const { return of_pixel[Place(x, y)]; }
  double& At(int x, int y) { return of_pixel[Place(x, y)]; }
  std::size_t Place(int x, int y) const {
    const auto side = static_cast<std::size_t>(reach) * 2 + 1;
    return static_cast<std::size_t>(y + reach) * side + static_cast<std::size_t>(x + reach);
  }
};

/// The area of each pixel that the stop's image covers, over the whole area.
Weights CoveredAreas(const LensStop& stop, double radius) {
  Weights weights;
  weights.reach = static_cast<int>(std::ceil(std::fabs(radius) - 0.5 + 1e-9));
  const int reach = weights.reach;
  weights.of_pixel.assign(weights.Place(reach, reach) + 1, 0.0);
  double area = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    double* const row = &weights.At(-reach, y);
    for (int i = 0; i < kRowsOfPixel; ++i) {
      const auto chord = ChordAt(stop, radius, y + (i + 0.5) / kRowsOfPixel - 0.5);
      if (!chord) continue;
      const int first = std::max(-reach, static_cast<int>(std::floor(chord->from + 0.5)));
      const int last = std::min(reach, static_cast<int>(std::floor(chord->to + 0.5)));
      for (int x = first; x <= last; ++x) {
        const double covered = std::min(chord->to, x + 0.5) - std::max(chord->from, x - 0.5);
        row[x + reach] += std::max(covered, 0.0);
        area += std::max(covered, 0.0);
      }
    }
  }
  if (area == 0.0) {
    weights.of_pixel[weights.of_pixel.size() / 2] = area = 1.0;
  }
  for (double& weight : weights.of_pixel) weight /= area;
  return weights;
}

/// The share of the light of a part of a pixel that reaches a pixel whose centre is `apart` from
/// its own, along one axis.
double Common(double part, double apart) {
  return std::clamp((0.5 * (part + 1.0) - std::fabs(apart)) / part, 0.0, std::min(1.0, 1.0 / part));
}

/// The share of the light of a part of a pixel that each pixel receives, by points of the stop.
Weights SpreadOf(const LensStop& stop, double radius, const PixelPart& part) {
  constexpr int kPoints = 40;  // Along each axis.
  const double width = part.is_whole ? 1.0 : 0.5;
  const double aside_x = 0.25 * part.x, aside_y = 0.25 * part.y;
  Weights weights;
  weights.reach = static_cast<int>(std::ceil(std::fabs(radius) - 1e-9));
  const int reach = weights.reach;
  weights.of_pixel.assign(weights.Place(reach, reach) + 1, 0.0);
  std::vector<double> along_x(weights.Place(reach, -reach) + 1);
  double sum = 0.0;
  for (int row = 0; row < kPoints; ++row) {
    const double v = std::fabs(radius) * (2.0 * (row + 0.5) / kPoints - 1.0);
    const auto chord = ChordAt(stop, radius, v);
    if (!chord) continue;
    std::ranges::fill(along_x, 0.0);
    for (int i = 0; i < kPoints; ++i) {
      const double u = chord->from + (chord->to - chord->from) * (i + 0.5) / kPoints;
      for (int x = -reach; x <= reach; ++x) {
        along_x[weights.Place(x, -reach)] += Common(width, x - aside_x - u);
      }
    }
    for (int y = -reach; y <= reach; ++y) {
      const double weight = Common(width, y - aside_y - v) * (chord->to - chord->from);
      for (int x = -reach; x <= reach; ++x) {
        const double share = weight * along_x[weights.Place(x, -reach)];
        weights.At(x, y) += share;
        sum += share;
      }
    }
  }
  if (sum == 0.0) weights.of_pixel[weights.of_pixel.size() / 2] = sum = 1.0;
  for (double& weight : weights.of_pixel) weight /= sum;
  return weights;
}

}  // namespace

DiscKernels::DiscKernels(const LensStop& stop)
    : stop_(stop), made_(std::size_t{2 * kSteps + 1} * kParts) {}

int DiscKernels::IndexOf(double signed_circle_px, PixelPart part) {
  const double circle = std::min(std::fabs(signed_circle_px), kMaxCircle_px);
  const double steps = circle < kMinCircle_px ? 0.0
                       : circle <= kFineUpTo_px
                           ? circle * kFinePerPixel
                           : kFineSteps + (circle - kFineUpTo_px) * kCoarsePerPixel;
  const int step = static_cast<int>(std::lround(steps));
  // All light of a part in focus stays in its pixel.
  const bool is_whole = part.is_whole || step == 0 || step > kFineSteps;
  return (kSteps + (signed_circle_px < 0.0 ? -step : step)) * kParts +
         (is_whole ? 0 : 1 + 3 * (part.y + 1) + part.x + 1);
}

void DiscKernels::Prepare(int index) {
  if (made_[static_cast<std::size_t>(index)]) return;
  auto kernel = std::make_unique<DiscKernel>();
  const int step = index / kParts - kSteps, part = index % kParts - 1;
  const double radius = 0.5 * CircleOf_px(step);
  const Weights weights =
      std::abs(step) > kFineSteps
          ? CoveredAreas(stop_, radius)
          : SpreadOf(stop_, radius,
                     part < 0 ? PixelPart{} : PixelPart{part % 3 - 1, part / 3 - 1, false});
  kernel->reach_px = weights.reach;
  for (int y = -weights.reach; y <= weights.reach; ++y) {
    const std::size_t first = kernel->steps.size();
    float last = 0.0F;
    for (int x = -weights.reach; x <= weights.reach + 1; ++x) {
      const float now = x > weights.reach ? 0.0F : static_cast<float>(weights.At(x, y));
      if (std::fabs(now - last) < kLeastRise && (now != 0.0F || last == 0.0F)) continue;
      kernel->steps.push_back({static_cast<std::int16_t>(x), now - last});
      last = now;
    }
    if (kernel->steps.size() == first) continue;
    kernel->rows.push_back({static_cast<std::int16_t>(y), static_cast<std::uint16_t>(first),
                            static_cast<std::uint16_t>(kernel->steps.size() - first)});
  }
  made_[static_cast<std::size_t>(index)] = std::move(kernel);
}

}  // namespace pleinair::compositor
