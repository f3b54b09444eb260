#include "tests/accuracy/key_frame.h"

#include <fmt/format.h>

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "app/compare/ciede2000.h"
#include "tests/e2e/run_program.h"

namespace pleinair::accuracy {

KeyFrame ReadKeyFrame(int frame) {
  const auto read = [&](const char* what, int flags) {
    return cv::imread(e2e::BundledRecording() / fmt::format("key/{:04}_{}.png", frame, what),
                      flags);
  };
  return {read("background", cv::IMREAD_COLOR), read("truth", cv::IMREAD_COLOR),
          read("objmask", cv::IMREAD_GRAYSCALE), read("shadow", cv::IMREAD_GRAYSCALE)};
}

Score Compare(const cv::Mat& picture, const KeyFrame& key, const cv::Mat& leave_out) {
  Score sum;
  int object_pixels = 0, shadow_pixels = 0, pixels = 0;
  cv::Mat around;
  cv::dilate((key.object_mask > 127) | (key.shadow > 0), around, cv::Mat::ones(51, 51, CV_8U));
  const auto lab = [](const cv::Vec3b& bgr) { return app::LabFromSrgb8({bgr[2], bgr[1], bgr[0]}); };
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const bool object = key.object_mask.at<std::uint8_t>(y, x) > 127;
      const bool shadow = key.shadow.at<std::uint8_t>(y, x) > 0;
      if (around.at<std::uint8_t>(y, x) == 0) continue;
      if (!leave_out.empty() && leave_out.at<std::uint8_t>(y, x) != 0) continue;
      const double difference =
          app::Ciede2000(lab(picture.at<cv::Vec3b>(y, x)), lab(key.truth.at<cv::Vec3b>(y, x)));
      sum.around += difference;
      sum.object += object ? difference : 0.0;
      sum.shadow += shadow ? difference : 0.0;
      ++pixels;
      object_pixels += object;
      shadow_pixels += shadow;
    }
  }
  return {sum.object / object_pixels, sum.shadow / shadow_pixels, sum.around / pixels};
}

}  // namespace pleinair::accuracy
