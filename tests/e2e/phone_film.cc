#include "tests/e2e/phone_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "base/srgb.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;

/// The recording's frames, as a phone held upright stores them: turned counter-clockwise.
cv::Mat Stored(int i) {
  const fs::path file = BundledRecording() / ("frames/000" + std::to_string(i) + ".jpg");
  cv::Mat turned;
  cv::rotate(cv::imread(file.string()), turned, cv::ROTATE_90_COUNTERCLOCKWISE);
  return turned;
}

/// Y'CbCr of a stored frame, by a curve and a matrix of luma and primaries, limited range.
template <typename Signal>
void Draw(AVFrame* frame, int i, double kr, double kb, const std::array<double, 9>& primaries,
          int depth, const Signal& signal) {
  const cv::Mat bgr = Stored(i);
  cv::Mat planes[3];
  for (cv::Mat& plane : planes) plane = cv::Mat(bgr.size(), CV_64F);
  const double unit = 1 << (depth - 8);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec3b& pixel = bgr.at<cv::Vec3b>(y, x);
      const double light[] = {LinearFromSrgb(pixel[2] / 255.0), LinearFromSrgb(pixel[1] / 255.0),
                              LinearFromSrgb(pixel[0] / 255.0)};
      double rgb[3];
      for (int c = 0; c < 3; ++c) {
        rgb[c] = signal(primaries[3 * c] * light[0] + primaries[3 * c + 1] * light[1] +
                        primaries[3 * c + 2] * light[2]);
      }
      const double luma = kr * rgb[0] + (1 - kr - kb) * rgb[1] + kb * rgb[2];
      planes[0].at<double>(y, x) = (219 * luma + 16) * unit;
      planes[1].at<double>(y, x) = (112 * (rgb[2] - luma) / (1 - kb) + 128) * unit;
      planes[2].at<double>(y, x) = (112 * (rgb[0] - luma) / (1 - kr) + 128) * unit;
    }
  }
  for (int p = 0; p < 3; ++p) {
    cv::Mat plane = planes[p];
    if (p > 0) cv::resize(plane, plane, {}, 0.5, 0.5, cv::INTER_AREA);
    for (int y = 0; y < plane.rows; ++y) {
      std::uint8_t* row = frame->data[p] + y * frame->linesize[p];
      for (int x = 0; x < plane.cols; ++x) {
        const auto code = static_cast<int>(std::lround(plane.at<double>(y, x)));
        if (depth == 8) row[x] = static_cast<std::uint8_t>(code);
        if (depth > 8) reinterpret_cast<std::uint16_t*>(row)[x] = static_cast<std::uint16_t>(code);
      }
    }
  }
}

constexpr std::array<double, 9> kSame{1, 0, 0, 0, 1, 0, 0, 0, 1};
// ITU-R BT.2087-0, Annex 1, M2.
constexpr std::array<double, 9> kBt2020{0.6274, 0.3293, 0.0433, 0.0691, 0.9195,
                                        0.0114, 0.0164, 0.0880, 0.8956};

/// ITU-R BT.2100-2, Table 5, with diffuse white at 75 %.
double Hlg(double light) {
  const double e = std::max(light, 0.0) * 0.264962560;
  return e <= 1.0 / 12.0 ? std::sqrt(3 * e)
                         : 0.17883277 * std::log(12 * e - 0.28466892) + 0.55991073;
}

}  // namespace

tests::MadeFilm PhoneFilm() {
  tests::MadeFilm film;
  film.width = 480;
  film.height = 640;
  film.ticks = {0, 1001, 9002};
  film.display = {0, 1, -1, 0};
  film.sound_encoder = "aac";
  film.sound_s = 0.3;
  film.tags = {{"com.apple.quicktime.location.ISO6709", "+50.0875+014.4213+220.0/"},
               {"com.apple.quicktime.creationdate", "2025-09-14T13:05:00+0200"}};
  film.muxer_options = {{"movflags", "use_metadata_tags"}};
  return film;
}

void WritePhoneFilm(const fs::path& file) {
  tests::MadeFilm film = PhoneFilm();
  film.transfer = 13;
  film.primaries = 1;
  film.matrix = 1;
  tests::WriteFilm(file, film, [](AVFrame* frame, int i) {
    Draw(frame, i, 0.2126, 0.0722, kSame, 8, [](double light) { return SrgbFromLinear(light); });
  });
}

void WriteHlgPhoneFilm(const fs::path& file) {
  tests::MadeFilm film = PhoneFilm();
  film.encoder = "libx265";
  film.pixels = "yuv420p10le";
  film.primaries = film.matrix = 9;
  film.transfer = 18;
  tests::WriteFilm(file, film,
                   [](AVFrame* frame, int i) { Draw(frame, i, 0.2627, 0.0593, kBt2020, 10, Hlg); });
}

}  // namespace pleinair::e2e
