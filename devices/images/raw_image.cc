#include "devices/images/raw_image.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "devices/images/jpeg_decoder.h"

namespace pleinair::devices {
namespace {

struct FormatName {
  PixelFormat format;
  std::string_view name;
};

constexpr FormatName kNames[] = {
    {PixelFormat::kGrey8, "GREY"},      {PixelFormat::kYuyv, "YUYV"},
    {PixelFormat::kYvyu, "YVYU"},       {PixelFormat::kUyvy, "UYVY"},
    {PixelFormat::kVyuy, "VYUY"},       {PixelFormat::kNv12, "NV12"},
    {PixelFormat::kNv21, "NV21"},       {PixelFormat::kYuv420, "YU12"},
    {PixelFormat::kRgb24, "RGB3"},      {PixelFormat::kBgr24, "BGR3"},
    {PixelFormat::kMjpeg, "MJPG"},      {PixelFormat::kBayerRggb8, "RGGB"},
    {PixelFormat::kBayerBggr8, "BA81"}, {PixelFormat::kBayerGbrg8, "GBRG"},
    {PixelFormat::kBayerGrbg8, "GRBG"}};

bool IsPackedYuv(PixelFormat format) {
  return format == PixelFormat::kYuyv || format == PixelFormat::kYvyu ||
         format == PixelFormat::kUyvy || format == PixelFormat::kVyuy;
}

bool IsPlanarYuv(PixelFormat format) {
  return format == PixelFormat::kNv12 || format == PixelFormat::kNv21 ||
         format == PixelFormat::kYuv420;
}

std::size_t Rows(const RawImage& raw) { return static_cast<std::size_t>(raw.height); }

std::size_t ChromaStride(const RawImage& raw) {
  return raw.format == PixelFormat::kYuv420 ? (raw.stride + 1) / 2 : raw.stride;
}

constexpr int kFractionBits = 14;
constexpr int kHalf = 1 << (kFractionBits - 1);

std::uint8_t Clamped(int scaled) {
  return static_cast<std::uint8_t>(std::clamp(scaled >> kFractionBits, 0, 255));
}

int Scaled(double value) {
  const double scaled = value * (1 << kFractionBits);
  return static_cast<int>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
}

/// R, G, B from 8-bit Y, Cb, Cr in integer arithmetic; within 1 of the exact value.
class YuvToRgb {
 public:
  // Rec. ITU-R BT.601-7, 2.5.1 and 2.5.2, and BT.709-6, 3.2 to 3.4, solved for R, G, B:
  // R = Y + 2 (1 - Kr) Cr, B = Y + 2 (1 - Kb) Cb, G = (Y - Kr R - Kb B) / Kg.
  YuvToRgb(YuvMatrix matrix, bool full_range) {
    const double kr = matrix == YuvMatrix::kBt601 ? 0.299 : 0.2126;
    const double kb = matrix == YuvMatrix::kBt601 ? 0.114 : 0.0722;
    const double kg = 1.0 - kr - kb;
    const double luma_gain = full_range ? 1.0 : 255.0 / 219.0;
    const double chroma_gain = full_range ? 1.0 : 255.0 / 224.0;
    luma_ = Scaled(luma_gain);
    black_ = full_range ? 0 : 16;
    red_cr_ = Scaled(2.0 * (1.0 - kr) * chroma_gain);
    blue_cb_ = Scaled(2.0 * (1.0 - kb) * chroma_gain);
    green_cr_ = -Scaled(2.0 * (1.0 - kr) * kr / kg * chroma_gain);
    green_cb_ = -Scaled(2.0 * (1.0 - kb) * kb / kg * chroma_gain);
  }

  void operator()(int y, int cb, int cr, std::uint8_t* rgb) const {
    const int luma = (y - black_) * luma_ + kHalf;
    const int u = cb - 128, v = cr - 128;
    rgb[0] = Clamped(luma + red_cr_ * v);
    rgb[1] = Clamped(luma + green_cb_ * u + green_cr_ * v);
    rgb[2] = Clamped(luma + blue_cb_ * u);
  }

 private:
  int luma_, black_, red_cr_, blue_cb_, green_cr_, green_cb_;
};

/// Positions of Y0, Y1, Cb and Cr in the four bytes of two pixels.
struct PackedOrder {
  int y0, y1, cb, cr;
};

PackedOrder OrderOf(PixelFormat format) {
  switch (format) {
    case PixelFormat::kYvyu:
      return {0, 2, 3, 1};
    case PixelFormat::kUyvy:
      return {1, 3, 0, 2};
    case PixelFormat::kVyuy:
      return {1, 3, 2, 0};
    default:
      return {0, 2, 1, 3};
  }
}

void ConvertPacked(const RawImage& raw, RgbImage* rgb) {
  const YuvToRgb convert(raw.matrix, raw.full_range);
  const PackedOrder at = OrderOf(raw.format);
  for (int y = 0; y < raw.height; ++y) {
    const std::uint8_t* from = raw.bytes.data() + static_cast<std::size_t>(y) * raw.stride;
    std::uint8_t* to = rgb->view().row(y);
    for (int x = 0; x < raw.width; x += 2, from += 4, to += 6) {
      convert(from[at.y0], from[at.cb], from[at.cr], to);
      if (x + 1 < raw.width) convert(from[at.y1], from[at.cb], from[at.cr], to + 3);
    }
  }
}

void ConvertPlanar(const RawImage& raw, RgbImage* rgb) {
  const YuvToRgb convert(raw.matrix, raw.full_range);
  const std::uint8_t* luma_plane = raw.bytes.data();
  const std::uint8_t* chroma_plane = luma_plane + raw.stride * Rows(raw);
  const std::size_t chroma_stride = ChromaStride(raw);
  const bool planar = raw.format == PixelFormat::kYuv420;
  const std::size_t second_plane = planar ? chroma_stride * ((Rows(raw) + 1) / 2) : 1;
  const std::size_t step = planar ? 1 : 2;
  for (int y = 0; y < raw.height; ++y) {
    const std::uint8_t* luma = luma_plane + static_cast<std::size_t>(y) * raw.stride;
    const std::uint8_t* first = chroma_plane + static_cast<std::size_t>(y / 2) * chroma_stride;
    const std::uint8_t* second = first + second_plane;
    if (raw.format == PixelFormat::kNv21) std::swap(first, second);
    std::uint8_t* to = rgb->view().row(y);
    for (int x = 0; x < raw.width; ++x, to += 3) {
      const std::size_t chroma = static_cast<std::size_t>(x / 2) * step;
      convert(luma[x], first[chroma], second[chroma], to);
    }
  }
}

cv::Mat Wrap(const RawImage& raw, int type) {
  return {raw.height, raw.width, type, const_cast<std::uint8_t*>(raw.bytes.data()), raw.stride};
}

/// OpenCV names a Bayer pattern after the second and third pixels of its second row; V4L2 and we
/// use the first two of the first row.
int BayerCode(PixelFormat format) {
  switch (format) {
    case PixelFormat::kBayerRggb8:
      return cv::COLOR_BayerBG2RGB;
    case PixelFormat::kBayerBggr8:
      return cv::COLOR_BayerRG2RGB;
    case PixelFormat::kBayerGbrg8:
      return cv::COLOR_BayerGR2RGB;
    default:
      return cv::COLOR_BayerGB2RGB;
  }
}

void ConvertByOpenCv(const RawImage& raw, cv::Mat rgb) {
  switch (raw.format) {
    case PixelFormat::kGrey8: {
      cv::Mat grey = Wrap(raw, CV_8UC1);
      if (!raw.full_range) grey.convertTo(grey, CV_8U, 255.0 / 219.0, -16.0 * 255.0 / 219.0);
      return cv::cvtColor(grey, rgb, cv::COLOR_GRAY2RGB);
    }
    case PixelFormat::kRgb24:
      return Wrap(raw, CV_8UC3).copyTo(rgb);
    case PixelFormat::kBgr24:
      return cv::cvtColor(Wrap(raw, CV_8UC3), rgb, cv::COLOR_BGR2RGB);
    default:
      return cv::demosaicing(Wrap(raw, CV_8UC1), rgb, BayerCode(raw.format));
  }
}

}  // namespace

std::string_view NameOf(PixelFormat format) {
  for (const FormatName& entry : kNames) {
    if (entry.format == format) return entry.name;
  }
  return "";
}

std::optional<PixelFormat> PixelFormatByName(std::string_view name) {
  for (const FormatName& entry : kNames) {
    if (entry.name == name) return entry.format;
  }
  return std::nullopt;
}

std::size_t TightStride(PixelFormat format, int width) {
  const auto columns = static_cast<std::size_t>(width);
  if (format == PixelFormat::kMjpeg) return 0;
  if (IsPackedYuv(format)) return (columns + 1) / 2 * 4;
  if (format == PixelFormat::kRgb24 || format == PixelFormat::kBgr24) return columns * 3;
  return columns;
}

std::size_t SmallestSize(const RawImage& layout) {
  if (layout.format == PixelFormat::kMjpeg) return 1;
  if (layout.height <= 0) return 1;
  const std::size_t tight = TightStride(layout.format, layout.width);
  if (IsPlanarYuv(layout.format)) {
    const std::size_t chroma_rows = (Rows(layout) + 1) / 2;
    const std::size_t planes = layout.format == PixelFormat::kYuv420 ? 2 : 1;
    return layout.stride * Rows(layout) + ChromaStride(layout) * chroma_rows * planes;
  }
  return layout.stride * (Rows(layout) - 1) + tight;
}

Result<void> ConvertRawImage(const RawImage& raw, DecodedImage* image) {
  const auto damaged = [](std::string what) {
    return InputError("", "the image is damaged: " + std::move(what));
  };
  if (raw.width <= 0 || raw.height <= 0 || raw.width > kMaxImageSide ||
      raw.height > kMaxImageSide) {
    return damaged("a size of " + std::to_string(raw.width) + "x" + std::to_string(raw.height));
  }
  if (raw.stride < TightStride(raw.format, raw.width)) {
    return damaged("rows of " + std::to_string(raw.stride) + " bytes are too short");
  }
  if (raw.bytes.size() < SmallestSize(raw)) {
    return damaged(std::to_string(raw.bytes.size()) + " bytes instead of " +
                   std::to_string(SmallestSize(raw)));
  }
  if (image->rgb.width() != raw.width || image->rgb.height() != raw.height) {
    image->rgb = RgbImage(raw.width, raw.height, 3);
    image->grey = GreyImage(raw.width, raw.height, 1);
  }
  cv::Mat rgb(raw.height, raw.width, CV_8UC3, image->rgb.data());
  cv::Mat grey(raw.height, raw.width, CV_8UC1, image->grey.data());
  try {
    if (raw.format == PixelFormat::kMjpeg) {
      PLEINAIR_RETURN_IF_ERROR(DecodeJpeg(raw.bytes, &image->rgb));
    } else if (IsPackedYuv(raw.format)) {
      ConvertPacked(raw, &image->rgb);
    } else if (IsPlanarYuv(raw.format)) {
      ConvertPlanar(raw, &image->rgb);
    } else {
      ConvertByOpenCv(raw, rgb);
    }
    // The same formula as for files, so that the tracker gets the same image live and from a
    // recording.
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  } catch (const std::exception& error) {
    return damaged(error.what());
  }
  return {};
}

}  // namespace pleinair::devices
