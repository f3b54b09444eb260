#include "tests/e2e/poster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/srgb.h"

namespace pleinair::e2e {
namespace {

// The lens of the bundled recording.
constexpr double kFocal_px = 605.0, kCentreX_px = 319.5, kCentreY_px = 239.5;
constexpr double kBlack = 0.04, kWhite = 0.80;
constexpr int kSamples = 3;  // Along a pixel's side.

Vec2 PixelOf(const Transform<Camera, Marker>& camera_from_marker, double x, double y) {
  const Vec3 p = (camera_from_marker * Point<Marker>{{x, y, 0}}).xyz;
  return {kFocal_px * p.x / p.z + kCentreX_px, kFocal_px * p.y / p.z + kCentreY_px};
}

/// Linear light of the white margin, for a reflectance of 1; B, G, R.
std::array<double, 3> LightOnTheMargin(const cv::Mat& frame,
                                       const Transform<Camera, Marker>& camera_from_marker) {
  std::array<double, 3> sum{};
  int count = 0;
  for (double along = -0.25; along <= 0.25; along += 0.01) {
    for (const auto& [x, y] :
         {std::pair{along, 0.275}, {along, -0.275}, {0.275, along}, {-0.275, along}}) {
      const Vec2 at = PixelOf(camera_from_marker, x, y);
      const cv::Point pixel(cvRound(at.x), cvRound(at.y));
      if (!cv::Rect(0, 0, frame.cols, frame.rows).contains(pixel)) continue;
      for (int c = 0; c < 3; ++c) sum[c] += LinearFromSrgb8()[frame.at<cv::Vec3b>(pixel)[c]];
      ++count;
    }
  }
  for (double& value : sum) value /= std::max(1, count) * kWhite;
  return sum;
}

}  // namespace

cv::Mat Poster(int seed) {
  cv::Mat poster(600, 800, CV_8UC1, cv::Scalar(120));
  cv::RNG random(seed);
  for (int i = 0; i < 700; ++i) {
    const int size = 8 + 90 * 90 / (90 + 3 * i);
    const cv::Point at(random.uniform(0, poster.cols), random.uniform(0, poster.rows));
    const cv::Size axes(random.uniform(size / 3, size) + 3, random.uniform(size / 3, size) + 3);
    cv::ellipse(poster, at, axes, random.uniform(0, 180), 0, 360,
                cv::Scalar(random.uniform(20, 230)), cv::FILLED, cv::LINE_AA);
  }
  return poster;
}

void PastePoster(const cv::Mat& poster, double width_m,
                 const Transform<Camera, Marker>& camera_from_marker, cv::Mat* frame) {
  const std::array<double, 3> light = LightOnTheMargin(*frame, camera_from_marker);
  const Transform<Marker, Camera> marker_from_camera = camera_from_marker.Inverse();
  const double height_m = width_m * poster.rows / poster.cols;
  cv::Mat linear(poster.size(), CV_32F);
  for (int y = 0; y < poster.rows; ++y) {
    for (int x = 0; x < poster.cols; ++x) {
      linear.at<float>(y, x) = LinearFromSrgb8()[poster.at<uchar>(y, x)];
    }
  }
  // At a distance one image pixel covers several poster pixels.
  cv::GaussianBlur(linear, linear, {}, 1.0);
  for (int y = 0; y < frame->rows; ++y) {
    for (int x = 0; x < frame->cols; ++x) {
      int inside = 0;
      double reflectance = 0.0;
      for (int sample = 0; sample < kSamples * kSamples; ++sample) {
        const double u = x - 0.5 + (sample % kSamples + 0.5) / kSamples;
        const double v = y - 0.5 + (sample / kSamples + 0.5) / kSamples;
        const Vec3 ray = marker_from_camera.rotation *
                         Vec3{(u - kCentreX_px) / kFocal_px, (v - kCentreY_px) / kFocal_px, 1.0};
        const Vec3 eye = marker_from_camera.translation_m;
        if (ray.z >= 0.0) continue;
        const Vec3 at = eye + ray * (-eye.z / ray.z);
        const double px = (at.x / width_m + 0.5) * poster.cols;
        const double py = (0.5 - at.y / height_m) * poster.rows;
        if (px < 0.0 || py < 0.0 || px >= poster.cols || py >= poster.rows) continue;
        ++inside;
        reflectance += kBlack + (kWhite - kBlack) *
                                    linear.at<float>(static_cast<int>(py), static_cast<int>(px));
      }
      if (inside == 0) continue;
      cv::Vec3b& pixel = frame->at<cv::Vec3b>(y, x);
      const double share = static_cast<double>(inside) / (kSamples * kSamples);
      for (int c = 0; c < 3; ++c) {
        const double before = LinearFromSrgb8()[pixel[c]];
        const double after = light[c] * reflectance / inside;
        const double mixed = before + share * (after - before);
        pixel[c] = Srgb8FromLinear(mixed);
      }
    }
  }
}

}  // namespace pleinair::e2e
