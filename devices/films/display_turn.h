#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/image.h"
#include "base/image_size.h"

namespace pleinair::devices {

/// How the stored image of a film is turned and mirrored for display: any of the eight symmetries
/// of a rectangle. Phones store portrait films as landscape and write the turn into the file.
class DisplayTurn {
 public:
  /// As stored.
  DisplayTurn() = default;

  /// From a track's matrix {a, b, u, c, d, v, x, y, w}, which maps the stored point (p, q) to
  /// (a p + c q + x, b p + d q + y) (ISO/IEC 14496-12:2022, 8.3.2.3); a to d in units of 1/65536.
  /// Errors: another rotation than by multiples of 90°, a shear, or a scale.
  static Result<DisplayTurn> FromMatrix(const std::array<std::int32_t, 9>& matrix,
                                        const std::string& name);

  bool operator==(const DisplayTurn&) const = default;

  ImageSize Turned(ImageSize stored) const;
  /// An image of any number of channels.
  Image<std::uint8_t> Turned(Image<std::uint8_t> stored) const;
  Image<std::uint16_t> Turned(Image<std::uint16_t> stored) const;

  /// Clockwise rotation before a possible left-right mirroring, degrees: 0, 90, 180 or 270.
  int clockwise_deg() const;
  bool mirrored() const;

 private:
  template <typename T>
  Image<T> TurnedPixels(Image<T> stored) const;

  DisplayTurn(int a, int b, int c, int d) : a_(a), b_(b), c_(c), d_(d) {}

  // The matrix's linear part: -1, 0 or 1.
  int a_ = 1, b_ = 0, c_ = 0, d_ = 1;
};

}  // namespace pleinair::devices
