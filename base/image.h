#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/check.h"

namespace pleinair {

/// Non-owning view of an image: rows from the top, channels interleaved, `stride` elements from one
/// row to the next.
template <typename T>
class ImageView {
 public:
  ImageView() = default;
  ImageView(T* data, int width, int height, int channels, std::ptrdiff_t stride)
      : data_(data), width_(width), height_(height), channels_(channels), stride_(stride) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  std::ptrdiff_t stride() const { return stride_; }
  bool empty() const { return width_ == 0 || height_ == 0; }
  T* data() const { return data_; }
  T* row(int y) const { return data_ + y * stride_; }
  T& operator()(int x, int y, int channel = 0) const { return row(y)[x * channels_ + channel]; }

  operator ImageView<const T>() const { return {data_, width_, height_, channels_, stride_}; }

 private:
  T* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  int channels_ = 1;
  std::ptrdiff_t stride_ = 0;
};

/// An image that owns its memory, without padding between rows.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, int channels = 1)
      : width_(width), height_(height), channels_(channels) {
    CHECK_GE(width, 0);
    CHECK_GE(height, 0);
    CHECK_GE(channels, 1);
    data_.resize(static_cast<std::size_t>(width) * height * channels);
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  bool empty() const { return data_.empty(); }
  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }
  std::size_t size() const { return data_.size(); }
  T& operator()(int x, int y, int channel = 0) {
    return data_[(static_cast<std::size_t>(y) * width_ + x) * channels_ + channel];
  }
  const T& operator()(int x, int y, int channel = 0) const {
    return data_[(static_cast<std::size_t>(y) * width_ + x) * channels_ + channel];
  }

  ImageView<T> view() {
    return {data(), width_, height_, channels_, static_cast<std::ptrdiff_t>(width_) * channels_};
  }
  ImageView<const T> view() const {
    return {data(), width_, height_, channels_, static_cast<std::ptrdiff_t>(width_) * channels_};
  }

 private:
  int width_ = 0;
  int height_ = 0;
  int channels_ = 1;
  std::vector<T> data_;
};

/// An image with the pixels of a view.
template <typename T>
Image<T> CopyImage(ImageView<const T> view) {
  Image<T> copy(view.width(), view.height(), view.channels());
  const std::size_t row = static_cast<std::size_t>(view.width()) * view.channels();
  for (int y = 0; y < view.height(); ++y) std::copy_n(view.row(y), row, copy.view().row(y));
  return copy;
}

using GreyImage = Image<std::uint8_t>;  ///< One channel, sRGB-encoded.
using RgbImage = Image<std::uint8_t>;   ///< Three channels R, G, B, sRGB-encoded.

}  // namespace pleinair
