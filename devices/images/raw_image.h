#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "devices/images/image_file.h"

namespace pleinair::devices {

/// The layouts of pixels that cameras send and we read; names as in Linux' V4L2 documentation.
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

/// Every format, in the order of our preference at equal size and rate: no compression first.
constexpr PixelFormat kPixelFormats[] = {
    PixelFormat::kYuyv,       PixelFormat::kUyvy,       PixelFormat::kYvyu,
    PixelFormat::kVyuy,       PixelFormat::kNv12,       PixelFormat::kNv21,
    PixelFormat::kYuv420,     PixelFormat::kRgb24,      PixelFormat::kBgr24,
    PixelFormat::kMjpeg,      PixelFormat::kBayerRggb8, PixelFormat::kBayerBggr8,
    PixelFormat::kBayerGbrg8, PixelFormat::kBayerGrbg8, PixelFormat::kGrey8};

/// "YUYV", "MJPG", "RGGB"…: the four letters that V4L2 has for it, without trailing spaces.
std::string_view NameOf(PixelFormat format);
std::optional<PixelFormat> PixelFormatByName(std::string_view name);

/// Which R, G, B a YUV image means (Rec. ITU-R BT.601-7 and BT.709-6).
enum class YuvMatrix { kBt601, kBt709 };

/// An image as the camera sent it.
struct RawImage {
  PixelFormat format = PixelFormat::kGrey8;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;  ///< Bytes of a row of the first plane; unused by kMjpeg.
  YuvMatrix matrix = YuvMatrix::kBt601;
  bool full_range = false;  ///< YUV and grey: black is 0 and white 255, not 16 and 235.
  std::vector<std::uint8_t> bytes;
};

/// Bytes that an image of this layout must have at least; 1 for kMjpeg.
std::size_t SmallestSize(const RawImage& layout);

/// Bytes of a row of the first plane without padding.
std::size_t TightStride(PixelFormat format, int width);

/// Our two pictures of a camera's one. Errors, which say "damaged": too few bytes; a JPEG that is
/// cut short, of another size, or that the decoder had to mend. `picture` is used again where it
/// has the size already.
Result<void> ConvertRawImage(const RawImage& raw, DecodedImage* image);

}  // namespace pleinair::devices
