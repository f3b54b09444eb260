#include "compositor/picture/occluder_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/srgb.h"

namespace pleinair::compositor {
namespace {

constexpr double kCovered = 0.35, kSeen = 0.75;  // Visibility of a square, below and above.
constexpr int kMinCoveredSquares = 3;            // Fewer squares are a highlight or a leaf.
// Color bins: logarithms of red and blue over green.
constexpr int kBins = 24;
constexpr double kWidestLog = 1.2;
// Sum of the three 8-bit channel values below which color is noise.
constexpr int kDarkestSum = 36;
// Minimum likelihood ratio of an occluder color to the marker's colors, and to those of the
// surroundings, where the occluder comes from.
constexpr double kLikelier = 3.0, kAsLikely = 0.8;
constexpr double kMinShareOfColor = 0.002, kNobodys = 0.002;
constexpr double kMinSeeds = 30.0;
constexpr int kClosings = 2, kClosingReach = 3;

struct Rect {
  int x0, y0, x1, y1;  // Inclusive.
};

class Masker {
 public:
  Masker(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
         const Transform<Camera, Marker>& pose, const MarkerVisibility& cover)
      : rgb_(rgb), camera_(camera), cover_(cover), marker_from_camera_(pose.Inverse()) {
    const double half = cover.marker_area_size_m / 2;
    Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
    for (const Vec2 c : {Vec2{-half, -half}, {half, -half}, {half, half}, {-half, half}}) {
      const Point<Camera> p = pose * Point<Marker>{{c.x, c.y, 0.0}};
      if (p.xyz.z <= 0.0) return;
      const Vec2 pixel = ProjectToPixel(camera, p);
      low = {std::min(low.x, pixel.x), std::min(low.y, pixel.y)};
      high = {std::max(high.x, pixel.x), std::max(high.y, pixel.y)};
    }
    marker_ = {std::max(0, static_cast<int>(low.x)), std::max(0, static_cast<int>(low.y)),
               std::min(rgb.width() - 1, static_cast<int>(high.x) + 1),
               std::min(rgb.height() - 1, static_cast<int>(high.y) + 1)};
  }

  Image<std::uint8_t> Make() {
    Image<std::uint8_t> mask(rgb_.width(), rgb_.height(), 1);
    // Counts the covered and the visible part of the marker, and the colors of each.
    for (int y = marker_.y0; y <= marker_.y1; ++y) {
      for (int x = marker_.x0; x <= marker_.x1; ++x) {
        const double seen = SeenAt(x, y);
        if (seen < 0.0) continue;
        inside_.push_back({x, y});
        if (seen < kCovered) {
          mask(x, y) = 255;
          CountColor(x, y, &covered_);
        } else if (seen > kSeen) {
          CountColor(x, y, &other_);
        }
      }
    }
    CountSurroundings();
    const std::vector<std::uint8_t> theirs = OccluderColors();
    if (!theirs.empty()) {
      Grow(theirs, &mask);
      // Nails, rings and dark folds inside a hand.
      for (int i = 0; i < kClosings; ++i) Average(kClosingReach, true, &mask);
    }
    Average(1, false, &mask);
    return mask;
  }

 private:
  struct Colors {
    std::array<double, kBins * kBins> counts{};
    double all = 0.0;
  };

  /// Visibility of the square under a pixel, interpolated between the squares' centres; −1 beside
  /// the marker.
  double SeenAt(int x, int y) const {
    const Vec2 ray = UndistortPixel(camera_, {static_cast<double>(x), static_cast<double>(y)});
    const Vec3 direction = marker_from_camera_.rotation * Vec3{ray.x, ray.y, 1.0};
    const Vec3 eye = marker_from_camera_.translation_m;
    if (direction.z == 0.0) return -1.0;
    const Vec3 at = eye + direction * (-eye.z / direction.z);
    const double u = (at.x / cover_.marker_area_size_m + 0.5) * cover_.side;
    const double v = (0.5 - at.y / cover_.marker_area_size_m) * cover_.side;
    if (u < 0.0 || v < 0.0 || u >= cover_.side || v >= cover_.side) return -1.0;
    const auto square = [&](int column, int row) {
      column = std::clamp(column, 0, cover_.side - 1);
      row = std::clamp(row, 0, cover_.side - 1);
      return cover_.seen[static_cast<std::size_t>(row) * cover_.side + column] / 255.0;
    };
    const int column = static_cast<int>(std::floor(u - 0.5));
    const int row = static_cast<int>(std::floor(v - 0.5));
    const double fu = u - 0.5 - column, fv = v - 0.5 - row;
    return (square(column, row) * (1 - fu) + square(column + 1, row) * fu) * (1 - fv) +
           (square(column, row + 1) * (1 - fu) + square(column + 1, row + 1) * fu) * fv;
  }

  /// −1 where a pixel is too dark or too bright to have a color.
  int BinOf(int x, int y) const {
    const int r = rgb_(x, y, 0), g = rgb_(x, y, 1), b = rgb_(x, y, 2);
    if (r + g + b < kDarkestSum || (r > 250 && g > 250 && b > 250)) return -1;
    const auto& linear = LinearFromSrgb8();
    const auto bin = [&](int code) {
      const double ratio = std::log((linear[code] + 1e-3) / (linear[g] + 1e-3));
      return std::clamp(static_cast<int>((ratio / kWidestLog + 1.0) / 2.0 * kBins), 0, kBins - 1);
    };
    return bin(r) * kBins + bin(b);
  }

  void CountColor(int x, int y, Colors* colors) const {
    const int bin = BinOf(x, y);
    if (bin < 0) return;
    colors->counts[bin] += 1.0;
    colors->all += 1.0;
  }

  /// A ring around the marker, including the arm that crosses it.
  void CountSurroundings() {
    constexpr int kStep = 2;
    const int reach = std::max(marker_.x1 - marker_.x0, marker_.y1 - marker_.y0) / 2;
    for (int y = std::max(0, marker_.y0 - reach);
         y <= std::min(rgb_.height() - 1, marker_.y1 + reach); y += kStep) {
      for (int x = std::max(0, marker_.x0 - reach);
           x <= std::min(rgb_.width() - 1, marker_.x1 + reach); x += kStep) {
        const bool beside = x < marker_.x0 || x > marker_.x1 || y < marker_.y0 || y > marker_.y1;
        if (beside) CountColor(x, y, &surroundings_);
      }
    }
  }

  /// Share of the colors in a bin and its eight neighbours: shading varies a hand's color a little.
  static double NearBy(const Colors& colors, int bin) {
    double sum = 0.0;
    for (int dr = -1; dr <= 1; ++dr) {
      for (int db = -1; db <= 1; ++db) {
        const int r = bin / kBins + dr, b = bin % kBins + db;
        if (r >= 0 && b >= 0 && r < kBins && b < kBins) sum += colors.counts[r * kBins + b];
      }
    }
    return sum / (9.0 * colors.all);
  }

  /// Flags the occluder's colors per bin. Empty if it has no color of its own.
  std::vector<std::uint8_t> OccluderColors() const {
    if (covered_.all < kMinSeeds || other_.all < kMinSeeds) return {};
    std::vector<std::uint8_t> theirs(kBins * kBins);
    double own = 0.0;
    for (int bin = 0; bin < kBins * kBins; ++bin) {
      const double covered = NearBy(covered_, bin);
      const double seen = other_.counts[bin] / other_.all;
      const double around =
          surroundings_.all > 0.0 ? surroundings_.counts[bin] / surroundings_.all : 0.0;
      // A color that occurs nowhere else belongs to its connected region: a redder fingertip.
      const bool nobodys = seen < kNobodys && around < kNobodys;
      const bool likely = covered >= kMinShareOfColor && covered >= kLikelier * seen &&
                          covered >= kAsLikely * around;
      if (!likely && !nobodys) continue;
      theirs[bin] = 1;
      own += covered_.counts[bin] / covered_.all;
    }
    constexpr double kMostlyOwn = 0.4;
    return own > kMostlyOwn ? theirs : std::vector<std::uint8_t>{};
  }

  /// Flood fill from the covered squares through the occluder's colors. In partly covered squares
  /// of the marker, color decides.
  void Grow(const std::vector<std::uint8_t>& theirs, Image<std::uint8_t>* mask) const {
    std::vector<std::pair<int, int>> open;
    for (const auto& [x, y] : inside_) {
      if ((*mask)(x, y) == 0) continue;
      const int bin = BinOf(x, y);
      if (bin >= 0 && theirs[bin] != 0) {
        open.emplace_back(x, y);
      } else {
        (*mask)(x, y) = 0;
      }
    }
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int nx = x + dx, ny = y + dy;
          if (nx < 0 || ny < 0 || nx >= rgb_.width() || ny >= rgb_.height()) continue;
          if ((*mask)(nx, ny) != 0) continue;
          const int bin = BinOf(nx, ny);
          if (bin < 0 || theirs[bin] == 0) continue;
          (*mask)(nx, ny) = 255;
          open.emplace_back(nx, ny);
        }
      }
    }
  }

  /// Averages over squares of pixels, which makes edges as soft as those of the image. If `fill`,
  /// it fills the middle of the mask instead.
  static void Average(int reach, bool fill, Image<std::uint8_t>* mask) {
    Image<std::uint8_t> means(mask->width(), mask->height());
    for (int y = 0; y < mask->height(); ++y) {
      for (int x = 0; x < mask->width(); ++x) {
        int sum = 0, count = 0;
        for (int v = std::max(0, y - reach); v <= std::min(mask->height() - 1, y + reach); ++v) {
          for (int u = std::max(0, x - reach); u <= std::min(mask->width() - 1, x + reach); ++u) {
            sum += (*mask)(u, v);
            ++count;
          }
        }
        int mean = sum / count;
        if (fill) mean = mean > 127 ? 255 : (*mask)(x, y);
        means(x, y) = static_cast<std::uint8_t>(mean);
      }
    }
    *mask = std::move(means);
  }

  ImageView<const std::uint8_t> rgb_;
  const CameraModel& camera_;
  const MarkerVisibility& cover_;
  Transform<Marker, Camera> marker_from_camera_;
  Rect marker_{0, 0, -1, -1};
  std::vector<std::pair<int, int>> inside_;
  Colors covered_, other_, surroundings_;
};

}  // namespace

Image<std::uint8_t> MaskOccluder(ImageView<const std::uint8_t> rgb, const CameraModel& camera,
                                 const Transform<Camera, Marker>& camera_from_marker,
                                 const MarkerVisibility& cover) {
  const auto covered = std::count_if(cover.seen.begin(), cover.seen.end(),
                                     [](std::uint8_t seen) { return seen < kCovered * 255; });
  if (cover.side <= 0 || covered < kMinCoveredSquares) return {};
  return Masker(rgb, camera, camera_from_marker, cover).Make();
}

void PutInFront(ImageView<const std::uint8_t> background, const Image<std::uint8_t>& mask,
                RgbImage* composed) {
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const int front = mask(x, y);
      if (front == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const int mixed = background(x, y, c) * front + (*composed)(x, y, c) * (255 - front);
        (*composed)(x, y, c) = static_cast<std::uint8_t>((mixed + 127) / 255);
      }
    }
  }
}

}  // namespace pleinair::compositor
