#include "app/compare/image_scores.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "app/compare/ciede2000.h"
#include "base/check.h"

namespace pleinair::app {
namespace {

constexpr int kNearPx = 25;
constexpr double kWhiteDifference = 10.0;

cv::Mat Wrapped(ImageView<const std::uint8_t> image) {
  return {image.height(), image.width(), CV_8UC(image.channels()),
          const_cast<std::uint8_t*>(image.data()), static_cast<std::size_t>(image.stride())};
}

cv::Mat ColorDifference(ImageView<const std::uint8_t> a, ImageView<const std::uint8_t> b) {
  cv::Mat difference(a.height(), a.width(), CV_64F);
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      difference.at<double>(y, x) = Ciede2000(LabFromSrgb8({a(x, y, 0), a(x, y, 1), a(x, y, 2)}),
                                              LabFromSrgb8({b(x, y, 0), b(x, y, 1), b(x, y, 2)}));
    }
  }
  return difference;
}

cv::Mat Ssim(const cv::Mat& a_rgb, const cv::Mat& b_rgb) {
  const auto luma = [](const cv::Mat& rgb) {
    cv::Mat grey;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_64F);
    return grey;
  };
  const auto smooth = [](const cv::Mat& values) {
    cv::Mat smoothed;
    cv::GaussianBlur(values, smoothed, {11, 11}, 1.5);
    return smoothed;
  };
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  const cv::Mat a = luma(a_rgb), b = luma(b_rgb);
  const cv::Mat mean_a = smooth(a), mean_b = smooth(b);
  const cv::Mat variance_a = smooth(a.mul(a)) - mean_a.mul(mean_a);
  const cv::Mat variance_b = smooth(b.mul(b)) - mean_b.mul(mean_b);
  const cv::Mat covariance = smooth(a.mul(b)) - mean_a.mul(mean_b);
  const cv::Mat numerator = (2 * mean_a.mul(mean_b) + kC1).mul(2 * covariance + kC2);
  const cv::Mat denominator =
      (mean_a.mul(mean_a) + mean_b.mul(mean_b) + kC1).mul(variance_a + variance_b + kC2);
  return numerator / denominator;
}

cv::Mat SquaredDifference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat x, y;
  a.convertTo(x, CV_64F);
  b.convertTo(y, CV_64F);
  const cv::Mat difference = x - y;
  cv::Mat mean;
  // Mean of three channels.
  cv::transform(difference.mul(difference), mean, cv::Matx13d(1 / 3.0, 1 / 3.0, 1 / 3.0));
  return mean;
}

double Mean(const cv::Mat& values, const cv::Mat& where) {
  if (cv::countNonZero(where) == 0) return PictureScores::kNone;
  return cv::mean(values, where)[0];
}

double Psnr(double mean_square) {
  return 10.0 * std::log10(255.0 * 255.0 / std::max(mean_square, 1e-6));
}

}  // namespace

PictureScores ScorePicture(ImageView<const std::uint8_t> picture,
                           ImageView<const std::uint8_t> truth, const PictureRegions& regions) {
  CHECK_EQ(picture.width(), truth.width());
  CHECK_EQ(picture.height(), truth.height());
  const cv::Mat a = Wrapped(picture), b = Wrapped(truth);
  const cv::Mat color = ColorDifference(picture, truth);
  const cv::Mat square = SquaredDifference(a, b), ssim = Ssim(a, b);
  PictureScores scores;
  scores.color_all = cv::mean(color)[0];
  scores.psnr = Psnr(cv::mean(square)[0]);
  scores.ssim = cv::mean(ssim)[0];
  if (regions.object.empty() || regions.shadow.empty()) return scores;
  const cv::Mat object = Wrapped(regions.object.view()) > 127;
  const cv::Mat shadow = Wrapped(regions.shadow.view()) > 0;
  scores.color_object = Mean(color, object);
  scores.color_shadow = Mean(color, shadow);
  cv::Mat near;
  cv::dilate(object | shadow, near, cv::Mat::ones(2 * kNearPx + 1, 2 * kNearPx + 1, CV_8U));
  if (cv::countNonZero(near) == 0) return scores;
  scores.color_near = Mean(color, near);
  scores.psnr_near = Psnr(Mean(square, near));
  scores.ssim_near = Mean(ssim, near);
  return scores;
}

RgbImage DifferencePicture(ImageView<const std::uint8_t> picture,
                           ImageView<const std::uint8_t> truth) {
  const cv::Mat color = ColorDifference(picture, truth);
  RgbImage shown(picture.width(), picture.height(), 3);
  const auto code = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  for (int y = 0; y < shown.height(); ++y) {
    for (int x = 0; x < shown.width(); ++x) {
      const double t = color.at<double>(y, x) / kWhiteDifference;
      shown(x, y, 0) = code(2 * t - 0.2);
      shown(x, y, 1) = code(2 * t - 1);
      shown(x, y, 2) = code(t < 0.3 ? 2.5 * t : t < 0.6 ? 0.75 - 2.5 * (t - 0.3) : 2.5 * (t - 0.6));
    }
  }
  return shown;
}

PictureScores MeanOf(const PictureScores* scores, std::size_t count) {
  std::array<double, 8> mean{};
  for (std::size_t k = 0; k < mean.size(); ++k) {
    double sum = 0.0;
    std::size_t known = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = scores[i].Values()[k];
      if (std::isnan(value)) continue;
      sum += value;
      ++known;
    }
    mean[k] = known > 0 ? sum / static_cast<double>(known) : PictureScores::kNone;
  }
  return {mean[0], mean[1], mean[2], mean[3], mean[4], mean[5], mean[6], mean[7]};
}

}  // namespace pleinair::app
