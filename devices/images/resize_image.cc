#include "devices/images/resize_image.h"

#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace pleinair::devices {

RgbImage ResizeRgb(ImageView<const std::uint8_t> rgb, int width, int height) {
  RgbImage resized(width, height, 3);
  cv::Mat target(height, width, CV_8UC3, resized.data());
  // OpenCV has no const view; this one is only read.
  const cv::Mat source(rgb.height(), rgb.width(), CV_8UC3, const_cast<std::uint8_t*>(rgb.data()),
                       static_cast<std::size_t>(rgb.stride()));
  const bool shrinks = width <= rgb.width() && height <= rgb.height();
  cv::resize(source, target, target.size(), 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
  return resized;
}

}  // namespace pleinair::devices
