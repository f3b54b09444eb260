#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// Supported pixel layouts of cameras; names as in the Linux V4L2 documentation.
enum class PixelFormat {
  kGrey8,
  kYuyv,
  kYvyu,
  kUyvy,
  kVyuy,
  kNv12,
  kNv21,
  kYuv420,  ///< Three planes Y, U, V; "YU12".
  kRgb24,
  kBgr24,
  kMjpeg,
  kBayerRggb8,
  kBayerBggr8,
  kBayerGbrg8,
  kBayerGrbg8,
};

/// All formats, in order of preference at equal size and rate: uncompressed first.
constexpr PixelFormat kPixelFormats[] = {
    PixelFormat::kYuyv,       PixelFormat::kUyvy,       PixelFormat::kYvyu,
    PixelFormat::kVyuy,       PixelFormat::kNv12,       PixelFormat::kNv21,
    PixelFormat::kYuv420,     PixelFormat::kRgb24,      PixelFormat::kBgr24,
    PixelFormat::kMjpeg,      PixelFormat::kBayerRggb8, PixelFormat::kBayerBggr8,
    PixelFormat::kBayerGbrg8, PixelFormat::kBayerGrbg8, PixelFormat::kGrey8};

/// "YUYV", "MJPG", "RGGB"…: the four-letter V4L2 code, without trailing spaces.
std::string_view NameOf(PixelFormat format);
std::optional<PixelFormat> PixelFormatByName(std::string_view name);

/// Conversion matrix of a YUV image (Rec. ITU-R BT.601-7 and BT.709-6).
enum class YuvMatrix { kBt601, kBt709 };

/// An image in the form that the camera sent.
struct RawImage {
  PixelFormat format = PixelFormat::kGrey8;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;  ///< Bytes per row of the first plane; unused by kMjpeg.
  YuvMatrix matrix = YuvMatrix::kBt601;
  bool full_range = false;  ///< YUV and grey: black is 0 and white 255, not 16 and 235.
  std::vector<std::uint8_t> bytes;
};

/// Minimum number of bytes of an image of this layout; 1 for kMjpeg.
std::size_t SmallestSize(const RawImage& layout);

/// Bytes per row of the first plane without padding.
std::size_t TightStride(PixelFormat format, int width);

/// Converts a camera image to our RGB and grey images. `image` is reused if it already has the
/// right size. Errors (the message contains "damaged"): too few bytes; a JPEG that is truncated, of
/// another size, or that the decoder had to repair.
Result<void> ConvertRawImage(const RawImage& raw, DecodedImage* image);

}  // namespace pleinair::devices
