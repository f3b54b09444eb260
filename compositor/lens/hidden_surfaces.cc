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

/// Channels of what is filled.
enum Channel { kChange = 0, kCircle = 3, kChannels = 4 };

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

/// Weight of what a pixel shows that is farther than a layer by kLayersApart. More than 1 where an
/// object lies behind real surfaces.
struct FartherParts {
  float object = 0.0F, real[2] = {};
  float Sum() const { return object + real[0] + real[1]; }
};

FartherParts FartherThan(const PixelSurfaces& surfaces, int layer, int x, int y) {
  const PixelSurfaces::Depth& depth = surfaces.DepthAt(x, y);
  FartherParts parts;
  if (depth.object_layer >= layer + kLayersApart) parts.object = surfaces.WholeCoverage(x, y);
  for (const int which : {0, 1}) {
    if (depth.real_layer[which] < layer + kLayersApart) continue;
    parts.real[which] = surfaces.RealShare(which, x, y);
  }
  return parts;
}

/// The changes of light of real surfaces in a window that are farther than a layer, as far as
/// pixels show them.
struct FartherChanges {
  Image<float> values, weights;

  FartherChanges(const PixelSurfaces& surfaces, const PixelRect& window, int layer)
      : values(window.width, window.height, kChannels), weights(values.width(), values.height()) {
    for (int row = 0; row < values.height(); ++row) {
      for (int column = 0; column < values.width(); ++column) {
        const int x = window.x + column, y = window.y + row;
        const FartherParts parts = FartherThan(surfaces, layer, x, y);
        const float real = parts.real[0] + parts.real[1];
        if (real <= 0.0F) continue;
        const PixelSurfaces::Depth& depth = surfaces.DepthAt(x, y);
        float* const value = &values(column, row);
        for (int c = 0; c < 3; ++c) {
          value[kChange + c] = surfaces.Change(x, y, c) / (1.0F - surfaces.SeenCoverage(x, y));
        }
        for (const int which : {0, 1}) {
          value[kCircle] += parts.real[which] / real * depth.real_circle_px[which];
        }
        weights(column, row) = real;
      }
    }
  }
};

}  // namespace

std::vector<HidingPixel> HidingPixels(const PixelSurfaces& surfaces, const PixelRect& window,
                                      int reach_px) {
  std::vector<HidingPixel> hiding;
  const Depths depths(surfaces, window, reach_px);
  if (!depths.HidesAny()) return hiding;
  for (int row = 0; row < window.height; ++row) {
    for (int column = 0; column < window.width; ++column) {
      const int layer = depths.HidesBehind(column, row);
      if (layer == kNone) continue;
      const int x = window.x + column, y = window.y + row;
      const float part = 1.0F - FartherThan(surfaces, layer, x, y).Sum();
      if (part <= 0.0F) continue;
      const bool is_object =
          surfaces.DepthAt(x, y).object_layer == layer && surfaces.WholeCoverage(x, y) > 0.0F;
      hiding.push_back({x, y, layer, part, is_object});
    }
  }
  return hiding;
}

HiddenSurface BehindObject(const HiddenImage& hidden, const ThinLens& lens, double fx,
                           const HidingPixel& pixel) {
  const int x = std::clamp(pixel.x, 0, hidden.objects.width() - 1);
  const int y = std::clamp(pixel.y, 0, hidden.objects.height() - 1);
  HiddenSurface surface{pixel.x, pixel.y};
  for (int c = 0; c < 4; ++c) surface.object[c] = pixel.part * hidden.objects(x, y, c);
  for (int c = 0; c < 3; ++c) surface.change[c] = pixel.part * (hidden.ratio(x, y, c) - 1.0F);
  const float object = hidden.dioptres(x, y, PinholeImage::kObject);
  surface.real_circle_px =
      DrawnCircle_px(lens, fx, hidden.dioptres(x, y, PinholeImage::kNearestReal));
  // Airlight before a real surface is in the objects' image, too.
  surface.object_circle_px =
      object > 0.0F ? DrawnCircle_px(lens, fx, object) : surface.real_circle_px;
  return surface;
}

float BehindLayer_dioptres(const ThinLens& lens, double fx, int layer) {
  const double circle_px = FirstCircle_px(layer + kLayersApart);
  return static_cast<float>(
      std::max(0.0, lens.focus_dioptres - circle_px / (fx * lens.aperture_m)));
}

std::vector<HiddenSurface> BehindRealSurfaces(const PixelSurfaces& surfaces,
                                              const PixelRect& window,
                                              std::span<const HidingPixel> pixels) {
  std::vector<HiddenSurface> hidden;
  std::array<std::vector<const HidingPixel*>, kLensLayers> by_layer;
  for (const HidingPixel& pixel : pixels) {
    if (!pixel.is_object) by_layer[static_cast<std::size_t>(pixel.layer)].push_back(&pixel);
  }
  for (int layer = 0; layer < kLensLayers; ++layer) {
    const auto& hiding = by_layer[static_cast<std::size_t>(layer)];
    if (hiding.empty()) continue;
    const FartherChanges farther(surfaces, window, layer);
    const Image<float> filled = FillFromNearest(farther.values, farther.weights);
    for (const HidingPixel* const pixel : hiding) {
      const float* const value = &filled(pixel->x - window.x, pixel->y - window.y);
      HiddenSurface surface{pixel->x, pixel->y};
      for (int c = 0; c < 3; ++c) surface.change[c] = pixel->part * value[kChange + c];
      surface.real_circle_px = value[kCircle];
      hidden.push_back(surface);
    }
  }
  return hidden;
}

}  // namespace pleinair::compositor
