#include "devices/films/display_turn.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace pleinair::devices {
namespace {

/// -1, 0 or 1, where a number of units 1/65536 is one of them up to rounding; else 2.
int Unit(std::int32_t value) {
  constexpr std::int64_t kOne = 65536;
  constexpr std::int64_t kRounding = 64;  // A thousandth: some recorders round sines and cosines.
  for (const int unit : {-1, 0, 1}) {
    if (std::abs(std::int64_t{value} - unit * kOne) <= kRounding) return unit;
  }
  return 2;
}

}  // namespace

Result<DisplayTurn> DisplayTurn::FromMatrix(const std::array<std::int32_t, 9>& matrix,
                                            const std::string& name) {
  const int a = Unit(matrix[0]), b = Unit(matrix[1]), c = Unit(matrix[3]), d = Unit(matrix[4]);
  const bool upright = std::abs(a) == 1 && b == 0 && c == 0 && std::abs(d) == 1;
  const bool turned = a == 0 && std::abs(b) == 1 && std::abs(c) == 1 && d == 0;
  if (upright || turned) return DisplayTurn(a, b, c, d);
  return InputError(name, "is to be shown rotated by another angle than a multiple of 90 degrees",
                    "export it from a video editor without a rotation");
}

ImageSize DisplayTurn::Turned(ImageSize stored) const {
  return a_ != 0 ? stored : ImageSize{stored.height, stored.width};
}

Image<std::uint8_t> DisplayTurn::Turned(Image<std::uint8_t> stored) const {
  return TurnedPixels(std::move(stored));
}

Image<std::uint16_t> DisplayTurn::Turned(Image<std::uint16_t> stored) const {
  return TurnedPixels(std::move(stored));
}

template <typename T>
Image<T> DisplayTurn::TurnedPixels(Image<T> stored) const {
  if (*this == DisplayTurn()) return stored;
  const ImageSize size = Turned(ImageSize{stored.width(), stored.height()});
  const int channels = stored.channels();
  Image<T> turned(size.width, size.height, channels);
  // The pixel (x, y) shows the stored one (a x + b y, c x + d y) plus an offset: the inverse of the
  // matrix is its transpose.
  const int from_x = a_ < 0 || b_ < 0 ? stored.width() - 1 : 0;
  const int from_y = c_ < 0 || d_ < 0 ? stored.height() - 1 : 0;
  for (int y = 0; y < size.height; ++y) {
    T* target = turned.view().row(y);
    for (int x = 0; x < size.width; ++x) {
      const T* source = &stored(from_x + a_ * x + b_ * y, from_y + c_ * x + d_ * y);
      target = std::copy_n(source, channels, target);
    }
  }
  return turned;
}

int DisplayTurn::clockwise_deg() const {
  if (a_ != 0) return d_ > 0 ? 0 : 180;
  return b_ > 0 ? 90 : 270;
}

bool DisplayTurn::mirrored() const { return a_ * d_ - b_ * c_ < 0; }

}  // namespace pleinair::devices
