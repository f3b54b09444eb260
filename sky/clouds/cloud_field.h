#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/clouds/cloud_layer.h"

namespace pleinair::clouds {

/// What a field holds within kCoverSquare_m around the place.
struct CloudStatistics {
  double cover = 0.0;               ///< Share of ground below columns deeper than CloudyDepth().
  double mean_optical_depth = 0.0;  ///< Mean of those columns; 0 without any.
};

/// A layer of clouds as a field of columns: vertical optical depth and height above the base, from
/// hashed noise. Cover and mean optical depth are those of the description within kCoverSquare_m at
/// 0 s, without the strip of CloudPassing. With cells of up to 8 km the square is a period of the
/// field, and they hold at all times. The field moves with the wind and keeps its shape.
///
/// Coordinates are east, north, up in metres from the place; the ground is a plane. A column's
/// extinction is uniform between the base and its top. Thread-safe.
class CloudField {
 public:
  static constexpr int kMaxSteps = 64;  ///< Pieces of a ray.

  /// The field of a layer. Fields of equal layers are shared while any of them lives, because one
  /// takes about 0.1 s and 4 MB.
  static std::shared_ptr<const CloudField> Of(const CloudLayer& layer);

  explicit CloudField(const CloudLayer& layer);
  /// The field of the same layer, displaced and with passing clouds, in 2 ms. `bare` has neither,
  /// and cells of up to 8 km.
  CloudField(const CloudField& bare, Vec2 displacement_m, const CloudPassing& passing);

  const CloudLayer& layer() const { return layer_; }

  /// Vertical optical depth of the column over a point of the ground.
  double ColumnDepth(double east_m, double north_m, double seconds) const {
    if (noise_.empty()) return uniform_depth_;
    const Vec2 place = InPeriods(east_m, north_m, seconds);
    return DepthOf(
        NoiseAt(static_cast<float>(place.x * kSide), static_cast<float>(place.y * kSide)));
  }

  /// Height of a column of that depth above the base.
  double ColumnHeight(double depth) const {
    const double relative = depth * inverse_reference_;
    return layer_.thickness_m * std::clamp(flat_share_ + (1.0 - flat_share_) * std::sqrt(relative),
                                           flat_share_ + kLeastHeight * (1.0 - flat_share_), 1.0);
  }

  /// A bound of the extinction, per metre.
  double MostExtinction() const;

  /// Extinction at a point, per metre.
  double Extinction(Vec3 point_m, double seconds) const;

  /// Optical depth from a point to space. `up`: unit vector; 0 where it does not rise.
  double DepthAlong(Vec3 from_m, Vec3 up, double seconds, int max_steps = kMaxSteps) const;

  /// Calls step(depth, midpoint_m, column_depth, length_m) for each piece of the ray through the
  /// layer that holds cloud, from below upwards. The depths sum to DepthAlong().
  template <typename Step>
  void March(Vec3 from_m, Vec3 up, double seconds, const Step& step,
             int max_steps = kMaxSteps) const;

  CloudStatistics Statistics(double seconds) const;

 private:
  static constexpr int kSide = 1024;     ///< Samples of a period, in each direction.
  static constexpr int kEntries = 2048;  ///< Size of the table of depths.
  static constexpr double kLeastHeight = 0.2;
  static constexpr double kMinRise = 1e-3;

  void MakeColumns();
  void AddPassing();
  /// The noise at the points by which cover and mean are defined, at 0 s.
  std::vector<float> NoiseOfSquare() const;
  /// Place in the field, in periods, 0…1.
  Vec2 InPeriods(double east_m, double north_m, double seconds) const;
  /// Noise, bilinear; coordinates in samples, 0…kSide.
  float NoiseAt(float x, float y) const {
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const int left = x0 & (kSide - 1), right = (x0 + 1) & (kSide - 1);
    const float* low = &noise_[static_cast<std::size_t>(y0 & (kSide - 1)) * kSide];
    const float* high = &noise_[static_cast<std::size_t>((y0 + 1) & (kSide - 1)) * kSide];
    const float a = low[left] + fx * (low[right] - low[left]);
    const float b = high[left] + fx * (high[right] - high[left]);
    return a + fy * (b - a);
  }

  /// Optical depth where the noise has that value: linear between the entries of the table.
  float DepthOf(float noise) const {
    const float place = std::clamp((noise - lowest_) * entries_per_unit_, 0.0F, kEntries - 1.001F);
    const auto entry = static_cast<std::size_t>(place);
    const float part = place - static_cast<float>(entry);
    return depths_[entry] + part * (depths_[entry + 1] - depths_[entry]);
  }

  CloudLayer layer_;
  double period_m_ = kCoverSquare_m;
  Vec2 velocity_m_s_;           ///< East, north.
  double uniform_depth_ = 0.0;  ///< Without noise.
  double inverse_reference_ = 0.0, flat_share_ = 1.0;
  std::vector<float> noise_;  ///< Rows to the north. Empty: uniform.
  double deviation_ = 0.0;    ///< The noise's, without passing clouds.
  float lowest_ = 0.0F, entries_per_unit_ = 0.0F;
  std::vector<float> depths_;
};

template <typename Step>
void CloudField::March(Vec3 from_m, Vec3 up, double seconds, const Step& step,
                       int max_steps) const {
  if (up.z < kMinRise) return;
  const double bottom = std::max(layer_.base_m, from_m.z);
  const double top = layer_.base_m + layer_.thickness_m;
  if (bottom >= top || (noise_.empty() && uniform_depth_ <= 0.0)) return;
  // A step is as wide as a sample of the noise, unless that makes too many.
  const double travel = (top - bottom) * std::hypot(up.x, up.y) / up.z;
  const double width = period_m_ / kSide;
  const int steps = noise_.empty() ? std::min(8, max_steps)
                                   : std::clamp(static_cast<int>(travel / width) + 1,
                                                std::min(8, max_steps), max_steps);
  const double rise = (top - bottom) / steps;
  for (int i = 0; i < steps; ++i) {
    const double low = bottom + i * rise;
    const double along = (low + 0.5 * rise - from_m.z) / up.z;
    const Vec3 middle = from_m + up * along;
    const double column = ColumnDepth(middle.x, middle.y, seconds);
    if (column <= 0.0) continue;
    const double height = ColumnHeight(column);
    // The part of the step that lies below the column's top.
    const double inside = std::clamp(layer_.base_m + height - low, 0.0, rise);
    if (inside > 0.0) step(column * inside / (height * up.z), middle, column, inside / up.z);
  }
}

}  // namespace pleinair::clouds
