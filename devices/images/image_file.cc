#include "devices/images/image_file.h"

#include <zlib.h>

#include <cstdint>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "devices/images/cv_image.h"
#include "devices/images/jpeg_decoder.h"
#include "files/text_file.h"

namespace pleinair::devices {
namespace {

constexpr std::size_t kMaxImageBytes = std::size_t{1} << 30;
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view kJpegStart = "\xFF\xD8";
constexpr std::string_view kJpegEnd = "\xFF\xD9";
constexpr const char* kWholeCopy = "get a whole copy of it";

std::uint8_t ByteAt(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

// Big-endian numbers, which both formats use.
std::uint32_t TwoBytesAt(std::string_view bytes, std::size_t at) {
  return ByteAt(bytes, at) * 256U + ByteAt(bytes, at + 1);
}

std::uint32_t FourBytesAt(std::string_view bytes, std::size_t at) {
  return TwoBytesAt(bytes, at) * 65536U + TwoBytesAt(bytes, at + 2);
}

tl::unexpected<Error> CutShort(const std::string& name) {
  return InputError(name, "is cut short: the image's end is missing", kWholeCopy);
}

Result<ImageSize> Judge(std::uint32_t width, std::uint32_t height, const std::string& name) {
  if (width == 0 || height == 0) {
    return InputError(name, "has no pixels", kWholeCopy);
  }
  if (width > kMaxImageSide || height > kMaxImageSide) {
    return InputError(name,
                      "is an image of " + std::to_string(width) + "x" + std::to_string(height) +
                          " pixels; at most " + std::to_string(kMaxImageSide) +
                          " on a side are read",
                      "scale it down");
  }
  return ImageSize{static_cast<int>(width), static_cast<int>(height)};
}

// Walks the chunks (W3C PNG, 5.3: length, type, data, CRC) to IEND.
Result<ImageSize> InspectPng(std::string_view bytes, const std::string& name) {
  constexpr std::size_t kHeaderEnd = 8 + 8 + 13 + 4;
  if (bytes.size() < kHeaderEnd) return CutShort(name);
  if (bytes.substr(12, 4) != "IHDR") {
    return InputError(name, "is a PNG without a header", kWholeCopy);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const ImageSize size,
                            Judge(FourBytesAt(bytes, 16), FourBytesAt(bytes, 20), name));
  std::size_t at = kPngSignature.size();
  while (true) {
    if (bytes.size() - at < 12) return CutShort(name);
    const std::size_t length = FourBytesAt(bytes, at);
    if (bytes.size() - at - 12 < length) return CutShort(name);
    // The decoder would print its own message about damage; check the CRC first.
    const auto* checked = reinterpret_cast<const unsigned char*>(bytes.data()) + at + 4;
    if (crc32(0, checked, static_cast<uInt>(length + 4)) != FourBytesAt(bytes, at + 8 + length)) {
      return InputError(name, "is damaged: a checksum does not match", kWholeCopy);
    }
    if (bytes.substr(at + 4, 4) == "IEND") break;
    at += 12 + length;
  }
  return size;
}

// Walks the marker segments (ITU-T T.81, B.1.1) to the scan. The frame header before it has the
// size, and an end marker must follow it (0xFF is stuffed inside a scan, so the marker cannot be
// data).
Result<ImageSize> InspectJpeg(std::string_view bytes, const std::string& name) {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t at = 2;
  while (true) {
    while (at + 1 < bytes.size() && ByteAt(bytes, at) == 0xFF && ByteAt(bytes, at + 1) == 0xFF) {
      ++at;  // Fill bytes before a marker.
    }
    if (bytes.size() < 4 || at > bytes.size() - 4) return CutShort(name);
    if (ByteAt(bytes, at) != 0xFF) return InputError(name, "is a damaged JPEG", kWholeCopy);
    const int marker = ByteAt(bytes, at + 1);
    const std::size_t length = TwoBytesAt(bytes, at + 2);
    if (length < 2) return InputError(name, "is a damaged JPEG", kWholeCopy);
    if (bytes.size() - at - 2 < length) return CutShort(name);
    const bool frame_header =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame_header && length >= 8) {
      height = TwoBytesAt(bytes, at + 5);
      width = TwoBytesAt(bytes, at + 7);
    }
    at += 2 + length;
    if (marker == 0xDA) break;
  }
  if (bytes.find(kJpegEnd, at) == std::string_view::npos) return CutShort(name);
  return Judge(width, height, name);
}

}  // namespace

Result<ImageSize> InspectImage(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with(kPngSignature)) return InspectPng(bytes, name);
  if (bytes.starts_with(kJpegStart)) return InspectJpeg(bytes, name);
  return InputError(name, "is neither a PNG nor a JPEG image", "convert it to PNG");
}

bool IsImageFile(const std::filesystem::path& file) {
  if (!files::CheckRegularFile(file)) return false;  // Opening a pipe waits for its writer.
  std::string start(kPngSignature.size(), '\0');
  std::ifstream(file, std::ios::binary)
      .read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == kPngSignature || start.starts_with(kJpegStart);
}

Result<ImageSize> InspectImageFile(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes, files::ReadWholeFile(file, kMaxImageBytes));
  return InspectImage(bytes, file.string());
}

namespace {

/// Nothing for colors that libjpeg does not convert to RGB (CMYK). Unlike OpenCV's decoder, it
/// refuses damage inside the image, and libjpeg prints nothing.
Result<std::optional<DecodedImage>> DecodeRgbJpeg(const std::string& bytes, ImageSize size,
                                                  const std::string& name) {
  DecodedImage image{RgbImage(size.width, size.height, 3), GreyImage(size.width, size.height, 1)};
  const std::vector<std::uint8_t> encoded(bytes.begin(), bytes.end());
  if (const auto decoded = DecodeJpeg(encoded, &image.rgb); !decoded) {
    const std::string& what = decoded.error().what;
    if (what.find("color conversion") != std::string::npos) return std::nullopt;
    return InputError(name, what, kWholeCopy);
  }
  const cv::Mat rgb(size.height, size.width, CV_8UC3, image.rgb.data());
  cv::Mat grey(size.height, size.width, CV_8UC1, image.grey.data());
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return image;
}

}  // namespace

DecodedImage ImageFromBgr(const cv::Mat& bgr) {
  DecodedImage image{RgbImage(bgr.cols, bgr.rows, 3), GreyImage(bgr.cols, bgr.rows, 1)};
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, image.rgb.data());
  cv::Mat grey(bgr.rows, bgr.cols, CV_8UC1, image.grey.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return image;
}

Result<DecodedImage> DecodeImageFile(const std::filesystem::path& file) {
  PLEINAIR_ASSIGN_OR_RETURN(std::string bytes, files::ReadWholeFile(file, kMaxImageBytes));
  PLEINAIR_ASSIGN_OR_RETURN(const ImageSize size, InspectImage(bytes, file.string()));
  if (bytes.starts_with(kJpegStart)) {
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<DecodedImage> decoded,
                              DecodeRgbJpeg(bytes, size, file.string()));
    if (decoded) return *std::move(decoded);
  }
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data());
    const cv::Mat bgr = cv::imdecode(encoded, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
    if (bgr.empty() || bgr.type() != CV_8UC3 || bgr.cols != size.width || bgr.rows != size.height) {
      return InputError(file.string(), "is damaged: the image cannot be decoded", kWholeCopy);
    }
    return ImageFromBgr(bgr);
  } catch (const std::exception&) {
    return InputError(file.string(), "is damaged: the image cannot be decoded", kWholeCopy);
  }
}

}  // namespace pleinair::devices
