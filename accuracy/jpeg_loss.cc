#include "accuracy/jpeg_loss.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "base/check.h"

namespace pleinair::accuracy {

GreyImage AfterJpeg(const GreyImage& grey, int quality) {
  GreyImage after(grey.width(), grey.height());
  if (grey.size() == 0) return after;
  const cv::Mat before(grey.height(), grey.width(), CV_8UC1,
                       const_cast<std::uint8_t*>(grey.data()));
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", before, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  const cv::Mat decoded = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  CHECK_EQ(decoded.rows, grey.height());
  CHECK_EQ(decoded.cols, grey.width());
  for (int y = 0; y < grey.height(); ++y) {
    std::copy_n(decoded.ptr<std::uint8_t>(y), grey.width(), after.data() + y * grey.width());
  }
  return after;
}

}  // namespace pleinair::accuracy
