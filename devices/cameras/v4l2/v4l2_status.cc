#include "devices/cameras/v4l2/v4l2_status.h"

#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>

namespace pleinair::devices {
namespace {

struct Pair {
  PixelFormat format;
  std::uint32_t four_cc;
};

constexpr Pair kPairs[] = {{PixelFormat::kGrey8, V4L2_PIX_FMT_GREY},
                           {PixelFormat::kYuyv, V4L2_PIX_FMT_YUYV},
                           {PixelFormat::kYvyu, V4L2_PIX_FMT_YVYU},
                           {PixelFormat::kUyvy, V4L2_PIX_FMT_UYVY},
                           {PixelFormat::kVyuy, V4L2_PIX_FMT_VYUY},
                           {PixelFormat::kNv12, V4L2_PIX_FMT_NV12},
                           {PixelFormat::kNv21, V4L2_PIX_FMT_NV21},
                           {PixelFormat::kYuv420, V4L2_PIX_FMT_YUV420},
                           {PixelFormat::kRgb24, V4L2_PIX_FMT_RGB24},
                           {PixelFormat::kBgr24, V4L2_PIX_FMT_BGR24},
                           {PixelFormat::kMjpeg, V4L2_PIX_FMT_MJPEG},
                           {PixelFormat::kMjpeg, V4L2_PIX_FMT_JPEG},
                           {PixelFormat::kBayerRggb8, V4L2_PIX_FMT_SRGGB8},
                           {PixelFormat::kBayerBggr8, V4L2_PIX_FMT_SBGGR8},
                           {PixelFormat::kBayerGbrg8, V4L2_PIX_FMT_SGBRG8},
                           {PixelFormat::kBayerGrbg8, V4L2_PIX_FMT_SGRBG8}};

}  // namespace

Error V4l2Error(const std::string& node, const std::string& doing, int error_number) {
  const auto make = [&](ErrorKind kind, std::string what, std::string remedy) {
    return Error{kind, node, doing + ": " + std::move(what), std::move(remedy)};
  };
  switch (error_number) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return make(ErrorKind::kInput, "there is no such camera (any more)",
                  "plug it in; 'pleinair devices' lists what is there");
    case EACCES:
    case EPERM:
      return make(ErrorKind::kInput, "you have no permission for this camera",
                  "add yourself to the group that owns it (usually video) and log in again");
    case EBUSY:
      return make(ErrorKind::kInput, "another program uses the camera",
                  "close that program, or choose another camera");
    case ENOSPC:
      return make(
          ErrorKind::kInput, "the USB bus has too little bandwidth left for these images",
          "request a smaller size, a lower frame rate or MJPG, or plug it into another USB port");
    case ENOTTY:
      return make(ErrorKind::kInput, "this is no camera", "'pleinair devices' lists cameras");
    default:
      return make(ErrorKind::kSystem, std::strerror(error_number),
                  "unplug the camera and plug it in again");
  }
}

std::uint32_t FourCcOf(PixelFormat format) {
  for (const Pair& pair : kPairs) {
    if (pair.format == format) return pair.four_cc;
  }
  return 0;
}

std::optional<PixelFormat> PixelFormatOf(std::uint32_t four_cc) {
  for (const Pair& pair : kPairs) {
    if (pair.four_cc == four_cc) return pair.format;
  }
  return std::nullopt;
}

std::string FourCcName(std::uint32_t four_cc) {
  std::string name;
  for (int i = 0; i < 4; ++i) {
    const auto letter = static_cast<char>(four_cc >> (8 * i) & 0x7F);
    name += letter >= ' ' && letter <= '~' ? letter : '.';
  }
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return four_cc >> 31 != 0 ? name + "-BE" : name;
}

}  // namespace pleinair::devices
