#include "tracker/alignment/observed_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/srgb.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

constexpr std::uint8_t kBrightest = 252;  ///< The brightest value that does not count as clipped.

/// Square of d value / d linear light of the sRGB curve: the inverse variance of the linear light.
const std::array<float, 256>& InverseVarianceOfCode() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int code = 0; code < 256; ++code) {
      const int low = std::max(0, code - 1), high = std::min(255, code + 1);
      const double slope =
          (high - low) / (255.0 * (LinearFromSrgb(high / 255.0) - LinearFromSrgb(low / 255.0)));
      values[code] = code > kBrightest ? 0.0F : static_cast<float>(slope * slope);
    }
    return values;
  }();
  return table;
}

/// Inverse variance of the mean of several values, from the noise of 8-bit values.
class InverseVarianceByNoise {
 public:
  explicit InverseVarianceByNoise(Clipping clipping) : clipping_(clipping) {}

  void Add(std::uint8_t code) {
    min_ = std::min(min_, table_[code]);
    max_ = std::max(max_, table_[code]);
    sum_ += table_[std::min(code, kBrightest)];
  }
  float OfMean(float share) const {
    return clipping_ == Clipping::kByLight || !(max_ > 0.0F) ? min_ : sum_ * share;
  }

 private:
  const std::array<float, 256>& table_ = InverseVarianceOfCode();
  Clipping clipping_;
  float min_ = std::numeric_limits<float>::max(), max_ = 0.0F, sum_ = 0.0F;
};

/// All equal, except for clipped values.
class UniformInverseVariance {
 public:
  void Add(std::uint8_t code) { brightest_ = std::max(brightest_, code); }
  float OfMean(float /*share*/) const { return brightest_ > kBrightest ? 0.0F : 1.0F; }

 private:
  std::uint8_t brightest_ = 0;
};

/// Means of the linear light of squares, and their inverse variance, accumulated from `nothing`.
template <typename InverseVariance>
void TakeMeans(ImageView<const std::uint8_t> grey, const PixelWindow& window,
               const InverseVariance& nothing, ObservedPatch* observed) {
  observed->value.resize(window.size());
  observed->inverse_variance.resize(window.size());
  const auto& linear = LinearFromSrgb8();
  const auto take = [&](auto side) {
    const float share = 1.0F / static_cast<float>(side * side);
    for (int y = 0; y < window.height; ++y) {
      for (int x = 0; x < window.width; ++x) {
        const std::uint8_t* row = grey.row((window.y0 + y) * side) + (window.x0 + x) * side;
        float sum = 0.0F;
        InverseVariance inverse_variance = nothing;
        for (int j = 0; j < side; ++j, row += grey.stride()) {
          for (int i = 0; i < side; ++i) {
            sum += linear[row[i]];
            inverse_variance.Add(row[i]);
          }
        }
        const std::size_t at = static_cast<std::size_t>(y) * window.width + x;
        observed->value[at] = sum * share;
        observed->inverse_variance[at] = inverse_variance.OfMean(share);
      }
    }
  };
  if (window.level == 0) {
    take(std::integral_constant<int, 1>{});  // Compile-time size: the loops over a square vanish.
  } else {
    take(1 << window.level);
  }
}

}  // namespace

float InverseVarianceOfLight(float linear) {
  return InverseVarianceOfCode()[Srgb8FromLinear(linear)];
}

void TakeLinearWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                      const PixelWindow& window, ObservedPatch* observed, Clipping clipping) {
  LookUpRays(lens, window, &observed->rays);
  observed->grey = grey;
  TakeMeans(grey, window, InverseVarianceByNoise(clipping), observed);
}

void TakeCodeWindow(const LensGrid& lens, ImageView<const std::uint8_t> reduced,
                    const PixelWindow& window, ObservedPatch* observed) {
  LookUpRays(lens, window, &observed->rays);
  observed->grey = {};
  observed->value.resize(window.size());
  observed->inverse_variance.assign(window.size(), 1.0F);
  for (int y = 0; y < window.height; ++y) {
    const std::uint8_t* row = reduced.row(window.y0 + y) + window.x0;
    for (int x = 0; x < window.width; ++x) {
      observed->value[static_cast<std::size_t>(y) * window.width + x] =
          static_cast<float>(row[x]) * (1.0F / 255.0F);
    }
  }
}

void TakeEvenWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                    const PixelWindow& window, ObservedPatch* observed) {
  LookUpRays(lens, window, &observed->rays);
  observed->grey = {};
  TakeMeans(grey, window, UniformInverseVariance(), observed);
}

std::optional<PixelWindow> WindowOfSquare(const LensGrid& lens, const Mat3& plane_from_undistorted,
                                          double side, int places, int width, int height, int level,
                                          int margin) {
  const Mat3 inverse = Adjugate(plane_from_undistorted);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  double sign = 0.0;
  for (int i = 0; i < 4 * places; ++i) {
    // Around the square: along its top, right, bottom and left.
    const double along = side * (i % places) / places;
    const Vec2 at = std::array<Vec2, 4>{
        Vec2{along, 0.0}, {side, along}, {side - along, side}, {0.0, side - along}}[i / places];
    const Vec3 undistorted = inverse * Vec3{at.x, at.y, 1.0};
    if (i > 0 && undistorted.z * sign <= 0.0) return std::nullopt;
    sign = undistorted.z;
    const Vec2 pixel =
        lens.PixelOfUndistorted({undistorted.x / undistorted.z, undistorted.y / undistorted.z});
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
    left = std::min(left, pixel.x);
    right = std::max(right, pixel.x);
    top = std::min(top, pixel.y);
    bottom = std::max(bottom, pixel.y);
  }
  const double scale = 1 << level;
  const auto first = [&](double full, int most) {
    return static_cast<int>(
        std::clamp(std::floor((full + 0.5) / scale - 0.5) - margin, 0.0, 1.0 * most));
  };
  const auto behind = [&](double full, int most) {
    return static_cast<int>(
        std::clamp(std::ceil((full + 0.5) / scale - 0.5) + 1 + margin, 0.0, 1.0 * most));
  };
  const int x0 = first(left, width >> level), y0 = first(top, height >> level);
  return PixelWindow{level, x0, y0, behind(right, width >> level) - x0,
                     behind(bottom, height >> level) - y0};
}

}  // namespace pleinair::tracker
