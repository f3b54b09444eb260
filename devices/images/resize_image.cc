#include "devices/images/resize_image.h"

#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace pleinair::devices {
namespace {

template <typename T>
Image<T> ResizeThreeChannels(ImageView<const T> image, int width, int height) {
  const int type = CV_MAKETYPE(cv::DataType<T>::depth, 3);
  Image<T> resized(width, height, 3);
  cv::Mat target(height, width, type, resized.data());
  // OpenCV has no const view; this one is only read.
  const cv::Mat source(image.height(), image.width(), type, const_cast<T*>(image.data()),
                       static_cast<std::size_t>(image.stride()) * sizeof(T));
  const bool shrinks = width <= image.width() && height <= image.height();
  cv::resize(source, target, target.size(), 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
  return resized;
}

}  // namespace

RgbImage ResizeRgb(ImageView<const std::uint8_t> rgb, int width, int height) {
  return ResizeThreeChannels(rgb, width, height);
}

DeepImage ResizeDeep(ImageView<const std::uint16_t> deep, int width, int height) {
  return ResizeThreeChannels(deep, width, height);
}

}  // namespace pleinair::devices
