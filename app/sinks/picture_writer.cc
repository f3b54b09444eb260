#include "app/sinks/picture_writer.h"

#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

/// libpng reports failures by longjmp: nothing with a destructor may live between here and there.
bool WritePngRows(std::FILE* file, png_const_bytep first_row, std::ptrdiff_t stride,
                  png_uint_32 width, png_uint_32 height) {
  const auto silent = [](png_structp, png_const_charp) {};
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr,
      [](png_structp failed, png_const_charp) { png_longjmp(failed, 1); }, silent);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_init_io(png, file);
  png_set_compression_level(png, 3);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB | PNG_FILTER_UP);
  png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < height; ++y) {
    png_write_row(png, first_row + static_cast<std::ptrdiff_t>(y) * stride);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

cv::Mat Wrap(ImageView<const std::uint8_t> rgb) {
  // OpenCV has no const view; nobody writes through this one.
  return {rgb.height(), rgb.width(), CV_8UC3, const_cast<std::uint8_t*>(rgb.data()),
          static_cast<std::size_t>(rgb.stride())};
}

}  // namespace

Result<void> WritePng(const std::filesystem::path& file, ImageView<const std::uint8_t> rgb) {
  CHECK_EQ(rgb.channels(), 3);
  errno = 0;
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return tl::make_unexpected(WriteError(file, errno));
  bool good = WritePngRows(out, rgb.data(), rgb.stride(), static_cast<png_uint_32>(rgb.width()),
                           static_cast<png_uint_32>(rgb.height()));
  int error_number = errno;
  if (std::fclose(out) != 0 && good) {
    good = false;
    error_number = errno;
  }
  if (good) return {};
  std::error_code ignored;
  // Never a device or a pipe that stands where a file was expected.
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
  return tl::make_unexpected(WriteError(file, error_number != 0 ? error_number : EIO));
}

std::vector<std::uint8_t> EncodeJpeg(ImageView<const std::uint8_t> rgb, int max_width,
                                     int quality) {
  cv::Mat bgr;
  cv::cvtColor(Wrap(rgb), bgr, cv::COLOR_RGB2BGR);
  if (bgr.cols > max_width) {
    const double scale = static_cast<double>(max_width) / bgr.cols;
    cv::resize(bgr, bgr, {}, scale, scale, cv::INTER_AREA);
  }
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

RgbImage ResizeRgb(ImageView<const std::uint8_t> rgb, int width, int height) {
  RgbImage resized(width, height, 3);
  cv::Mat target(height, width, CV_8UC3, resized.data());
  const bool shrinks = width <= rgb.width() && height <= rgb.height();
  cv::resize(Wrap(rgb), target, target.size(), 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_CUBIC);
  return resized;
}

}  // namespace pleinair::app
