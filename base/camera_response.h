#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/srgb.h"

namespace pleinair {

/// Radiometric response of a camera: maps linear light to 8-bit pixel values, per channel
/// (Grossberg & Nayar 2003, "What is the Space of Camera Response Functions?"). Linear light is
/// relative to the brightest value that the camera can encode, which is 1. The default is the sRGB
/// curve.
class CameraResponse {
 public:
  CameraResponse() {
    for (auto& channel : linear_) channel = LinearFromSrgb8();
  }

  /// Interpolates samples with a monotone cubic (Fritsch & Carlson 1980), so that a few samples
  /// suffice. `light[c]` is the linear light at `encoded` (0…1, pixel value / 255) in channel c.
  /// Returns nullopt unless both lists rise strictly from 0 to 1 and hold at least two samples.
  static std::optional<CameraResponse> FromSamples(
      const std::vector<double>& encoded, const std::array<std::vector<double>, 3>& light) {
    CameraResponse response;
    response.is_srgb_ = false;
    if (!RisesFromZeroToOne(encoded)) return std::nullopt;
    for (int c = 0; c < 3; ++c) {
      if (light[c].size() != encoded.size() || !RisesFromZeroToOne(light[c])) return std::nullopt;
      Fill(encoded, light[c], &response.linear_[c]);
    }
    return response;
  }

  bool operator==(const CameraResponse&) const = default;

  bool IsSrgb() const { return is_srgb_; }

  /// Linear light of the 256 pixel values of a channel.
  const std::array<float, 256>& Linear(int channel) const { return linear_[channel]; }

  /// Linear light of a pixel value in 16 bits (65,535 is 255), interpolated between those of 8.
  float LinearOf16(std::uint16_t value, int channel) const {
    constexpr int kPerCode = 257;
    const int code = value / kPerCode, rest = value % kPerCode;
    const auto& table = linear_[channel];
    if (rest == 0) return table[code];
    return table[code] + (table[code + 1] - table[code]) * static_cast<float>(rest) / kPerCode;
  }

  /// Encoded value (0…1) of linear light; clamps to 0…1.
  double Encoded(double light, int channel) const {
    if (is_srgb_) return SrgbFromLinear(light);
    const auto& table = linear_[channel];
    const auto above = std::upper_bound(table.begin(), table.end(), static_cast<float>(light));
    if (above == table.begin()) return 0.0;
    if (above == table.end()) return 1.0;
    const auto code = static_cast<double>(above - table.begin());
    const double low = *(above - 1), high = *above;
    return (code - 1.0 + (light - low) / (high - low)) / 255.0;
  }

  /// Nearest 8-bit pixel value of linear light.
  std::uint8_t Encoded8(double light, int channel) const {
    return static_cast<std::uint8_t>(std::lround(Encoded(light, channel) * 255.0));
  }

 private:
  static bool RisesFromZeroToOne(const std::vector<double>& values) {
    // Smallest step that a float resolves over 256 pixel values.
    constexpr double kMinStep = 1e-6;
    if (values.size() < 2 || values.front() != 0.0 || values.back() != 1.0) return false;
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (!(values[i] - values[i - 1] >= kMinStep)) return false;
    }
    return true;
  }

  static void Fill(const std::vector<double>& x, const std::vector<double>& y,
                   std::array<float, 256>* table) {
    const std::size_t n = x.size();
    const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
    std::vector<double> slope(n);
    slope[0] = chord(0);
    slope[n - 1] = chord(n - 2);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      // The harmonic mean keeps the curve monotone (Fritsch & Butland 1984).
      slope[i] = 2.0 * chord(i - 1) * chord(i) / (chord(i - 1) + chord(i));
    }
    std::size_t i = 0;
    for (int code = 0; code < 256; ++code) {
      const double at = code / 255.0;
      while (i + 2 < n && at > x[i + 1]) ++i;
      const double h = x[i + 1] - x[i], t = (at - x[i]) / h;
      const double value = y[i] * (1 + 2 * t) * (1 - t) * (1 - t) +
                           h * slope[i] * t * (1 - t) * (1 - t) + y[i + 1] * t * t * (3 - 2 * t) +
                           h * slope[i + 1] * t * t * (t - 1);
      // Strictly rising in spite of rounding, so that the inverse is unique.
      const float floor = code == 0 ? 0.0F : std::nextafter((*table)[code - 1], 2.0F);
      (*table)[code] = std::max(floor, static_cast<float>(value));
    }
  }

  bool is_srgb_ = true;
  std::array<std::array<float, 256>, 3> linear_{};
};

}  // namespace pleinair
