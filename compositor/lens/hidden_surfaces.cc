#include "compositor/lens/hidden_surfaces.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>

#include "base/image.h"
#include "compositor/lens/lens_layers.h"
#include "compositor/lens/nearest_fill.h"

namespace pleinair::compositor {
namespace {

constexpr int kNone = -1;

/// Channels of what is filled, by the weight of a pixel's farther surfaces.
enum Channel { kObject = 0, kChange = 4, kObjectCircle = 7, kRealCircle = 8, kChannels = 9 };

/// The largest value within `reach` along a line of values that are `step` apart.
void MaxAlong(int* values, int count, std::ptrdiff_t step, int reach, std::vector<int>* line) {
  line->resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) (*line)[static_cast<std::size_t>(i)] = values[i * step];
  for (int i = 0; i < count; ++i) {
    const int first = std::max(0, i - reach), last = std::min(count - 1, i + reach);
    values[i * step] = *std::max_element(line->begin() + first, line->begin() + last + 1);
  }
}

/// Layers of the surfaces of a window that a hidden one may lie behind, or be taken from.
class Depths {
 public:
  Depths(const PixelSurfaces& surfaces, const PixelRect& window, int reach_px)
      : width_(window.width),
        front_(static_cast<std::size_t>(width_) * window.height, kNone),
        farthest_(front_.size(), kNone) {
    int nearest_front = kLensLayers, farthest_of_all = kNone;
    for (int row = 0; row < window.height; ++row) {
      for (int column = 0; column < width_; ++column) {
        const int x = window.x + column, y = window.y + row;
        const PixelSurfaces::Depth& depth = surfaces.DepthAt(x, y);
        int& front = front_[Place(column, row)];
        // Plain real surfaces are shown by the frame. They need no search.
        int& farthest = farthest_[Place(column, row)];
        if (surfaces.WholeCoverage(x, y) > 0.0F) farthest = depth.object_layer;
        if (surfaces.SeenCoverage(x, y) > 0.0F) front = depth.object_layer;
        if (surfaces.IsOccluder(depth.real_layer[0], x, y) && surfaces.RealShare(0, x, y) > 0.0F) {
          front = front == kNone ? depth.real_layer[0] : std::min<int>(front, depth.real_layer[0]);
        }
        if (depth.has_change) farthest = std::max<int>(farthest, depth.real_layer[1]);
        if (front != kNone) nearest_front = std::min(nearest_front, front);
        farthest_of_all = std::max(farthest_of_all, farthest);
      }
    }
    hides_any_ = farthest_of_all >= nearest_front + kLayersApart;
    if (!hides_any_) return;
    std::vector<int> line;
    for (int y = 0; y < window.height; ++y) {
      MaxAlong(&farthest_[Place(0, y)], width_, 1, reach_px, &line);
    }
    for (int x = 0; x < width_; ++x) {
      MaxAlong(&farthest_[Place(x, 0)], window.height, width_, reach_px, &line);
    }
  }

  bool HidesAny() const { return hides_any_; }
  /// Layer behind which a pixel hides a surface; kNone where it hides nothing. `x`, `y`: from the
  /// window's first pixel.
  int HidesBehind(int x, int y) const {
    const int front = front_[Place(x, y)];
    return front != kNone && farthest_[Place(x, y)] >= front + kLayersApart ? front : kNone;
  }

 private:
  std::size_t Place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  bool hides_any_ = false;
  std::vector<int> front_, farthest_;
};

/// What the pixels of a window show that is farther than a layer by kLayersApart, with the part of
/// each that does.
struct Farther {
  Image<float> values, weights;

  Farther(const PixelSurfaces& surfaces, const PixelRect& window, int layer)
      : values(window.width, window.height, kChannels), weights(values.width(), values.height()) {
    for (int row = 0; row < values.height(); ++row) {
      for (int column = 0; column < values.width(); ++column) {
        const int x = window.x + column, y = window.y + row;
        const PixelSurfaces::Depth& depth = surfaces.DepthAt(x, y);
        float* const value = &values(column, row);
        float& weight = weights(column, row);
        const float coverage = surfaces.WholeCoverage(x, y);
        if (coverage > 0.0F && depth.object_layer >= layer + kLayersApart) {
          std::copy_n(surfaces.WholeObject(x, y), 4, value + kObject);
          value[kObjectCircle] = coverage * depth.object_circle_px;
          weight += coverage;
        }
        float real = 0.0F;
        for (const int which : {0, 1}) {
          if (depth.real_layer[which] < layer + kLayersApart) continue;
          const float share = surfaces.RealShare(which, x, y);
          real += share;
          value[kRealCircle] += share * depth.real_circle_px[which];
        }
        if (real > 0.0F) {
          const float part = real / (1.0F - surfaces.SeenCoverage(x, y));
          for (int c = 0; c < 3; ++c) value[kChange + c] = part * surfaces.Change(x, y, c);
          weight += real;
        }
        if (weight > 0.0F) {  // More than 1 where an object lies behind real surfaces.
          for (int c = 0; c < kChannels; ++c) value[c] /= weight;
        }
      }
    }
  }
};

}  // namespace

std::vector<HiddenSurface> HiddenSurfaces(const PixelSurfaces& surfaces, const PixelRect& window,
                                          int reach_px) {
  std::vector<HiddenSurface> hidden;
  const Depths depths(surfaces, window, reach_px);
  if (!depths.HidesAny()) return hidden;
  std::array<std::vector<std::array<int, 2>>, kLensLayers> hiding;  // Pixels by layer.
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      const int layer = depths.HidesBehind(x, y);
      if (layer != kNone) hiding[static_cast<std::size_t>(layer)].push_back({x, y});
    }
  }
  for (int layer = 0; layer < kLensLayers; ++layer) {
    const auto& pixels = hiding[static_cast<std::size_t>(layer)];
    if (pixels.empty()) continue;
    const Farther farther(surfaces, window, layer);
    const Image<float> filled = FillFromNearest(farther.values, farther.weights);
    for (const auto& [column, row] : pixels) {
      const float part = 1.0F - std::min(farther.weights(column, row), 1.0F);
      if (part <= 0.0F) continue;
      const float* const value = &filled(column, row);
      HiddenSurface surface{window.x + column, window.y + row};
      const PixelSurfaces::Depth& depth = surfaces.DepthAt(surface.x, surface.y);
      // What real surfaces hide of objects is known.
      const bool is_object =
          depth.object_layer == layer && surfaces.WholeCoverage(surface.x, surface.y) > 0.0F;
      for (int c = 0; c < 4 && is_object; ++c) surface.object[c] = part * value[kObject + c];
      for (int c = 0; c < 3; ++c) surface.change[c] = part * value[kChange + c];
      const float object_part = value[kObject + 3], real_part = 1.0F - object_part;
      if (object_part > 0.0F) surface.object_circle_px = value[kObjectCircle] / object_part;
      if (real_part > 0.0F) surface.real_circle_px = value[kRealCircle] / real_part;
      hidden.push_back(surface);
    }
  }
  return hidden;
}

}  // namespace pleinair::compositor
