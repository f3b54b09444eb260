#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair {

using DeepImage = Image<std::uint16_t>;  ///< As RgbImage, in 16 bits: 65,535 is 255.

/// View of a camera's image for measuring light and for drawing. Three channels, encoded by the
/// camera's response. They have 8 bits. Sources that have more or are converted give the same image
/// in 16 bits, too.
class CameraImageView {
 public:
  CameraImageView() = default;
  // Implicit: most sources have 8 bits.
  CameraImageView(ImageView<const std::uint8_t> rgb) : rgb_(rgb) {}
  CameraImageView(ImageView<std::uint8_t> rgb) : rgb_(rgb) {}
  /// `deep` has the size of `rgb`, or is empty.
  CameraImageView(ImageView<const std::uint8_t> rgb, ImageView<const std::uint16_t> deep)
      : rgb_(rgb), deep_(deep) {}

  int width() const { return rgb_.width(); }
  int height() const { return rgb_.height(); }
  ImageView<const std::uint8_t> rgb() const { return rgb_; }
  /// Empty if the source has 8 bits and is not converted.
  ImageView<const std::uint16_t> deep() const { return deep_; }

 private:
  ImageView<const std::uint8_t> rgb_;
  ImageView<const std::uint16_t> deep_;
};

}  // namespace pleinair
