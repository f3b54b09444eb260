#include "export/images/image_writer.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "base/atomic_file.h"
#include "files/png_rows.h"

namespace pleinair::exports {
namespace {

cv::Mat Wrap(ImageView<const std::uint8_t> rgb) {
  // OpenCV has no const view; nothing writes through this one.
  return {rgb.height(), rgb.width(), CV_8UC3, const_cast<std::uint8_t*>(rgb.data()),
          static_cast<std::size_t>(rgb.stride())};
}

}  // namespace

Result<void> WritePng(const std::filesystem::path& file, ImageView<const std::uint8_t> rgb) {
  CHECK_EQ(rgb.channels(), 3);
  const bool device = IsDevice(file);
  const std::filesystem::path temporary = device ? file : TemporarySibling(file);
  errno = 0;
  std::FILE* out = std::fopen(temporary.c_str(), "wb");
  if (out == nullptr) return tl::make_unexpected(WriteError(file, errno));
  bool good = files::WritePngRows(rgb, {.fast = true}, out);
  int error_number = errno;
  if (std::fclose(out) != 0 && good) {
    good = false;
    error_number = errno;
  }
  if (good) return device ? Result<void>() : CommitFile(temporary, file);
  std::error_code ignored;
  if (!device) std::filesystem::remove(temporary, ignored);
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

}  // namespace pleinair::exports
