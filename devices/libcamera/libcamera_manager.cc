#include "devices/libcamera/libcamera_manager.h"

#include <libcamera/formats.h>
#include <libcamera/logging.h>
#include <sys/stat.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <mutex>

namespace pleinair::devices {
namespace {

/// libcamera's names follow the kernel's display drivers: its RGB888 has blue in the first byte.
struct Known {
  libcamera::PixelFormat theirs;
  PixelFormat ours;
};
const Known kKnown[] = {{libcamera::formats::YUYV, PixelFormat::kYuyv},
                        {libcamera::formats::YVYU, PixelFormat::kYvyu},
                        {libcamera::formats::UYVY, PixelFormat::kUyvy},
                        {libcamera::formats::VYUY, PixelFormat::kVyuy},
                        {libcamera::formats::NV12, PixelFormat::kNv12},
                        {libcamera::formats::NV21, PixelFormat::kNv21},
                        {libcamera::formats::YUV420, PixelFormat::kYuv420},
                        {libcamera::formats::BGR888, PixelFormat::kRgb24},
                        {libcamera::formats::RGB888, PixelFormat::kBgr24},
                        {libcamera::formats::MJPEG, PixelFormat::kMjpeg},
                        {libcamera::formats::SRGGB8, PixelFormat::kBayerRggb8},
                        {libcamera::formats::SBGGR8, PixelFormat::kBayerBggr8},
                        {libcamera::formats::SGBRG8, PixelFormat::kBayerGbrg8},
                        {libcamera::formats::SGRBG8, PixelFormat::kBayerGrbg8},
                        {libcamera::formats::R8, PixelFormat::kGrey8}};

/// The one manager, and how to wait until the last one is gone.
struct OnlyManager {
  std::mutex mutex;
  std::condition_variable gone;
  bool exists = false;
  std::weak_ptr<libcamera::CameraManager> running;
};
OnlyManager& TheOnlyOne() {
  static OnlyManager only;
  return only;
}

void StopManager(libcamera::CameraManager* manager) {
  manager->stop();
  delete manager;
  const std::lock_guard lock(TheOnlyOne().mutex);
  TheOnlyOne().exists = false;
  TheOnlyOne().gone.notify_all();
}

}  // namespace

Result<std::shared_ptr<libcamera::CameraManager>> LibcameraManager() {
  // Not kept beyond its users: the thread of 0.0.3 that hears what is plugged in does not survive
  // every order in which nodes come and go, so it runs only while somebody needs it.
  OnlyManager& only = TheOnlyOne();
  std::unique_lock lock(only.mutex);
  std::shared_ptr<libcamera::CameraManager> manager;
  only.gone.wait(lock, [&] { return (manager = only.running.lock()) || !only.exists; });
  if (manager) return manager;
  // What the user needs to know is in our errors; who wants more asks for it as libcamera says.
  if (std::getenv("LIBCAMERA_LOG_LEVELS") == nullptr) {
    libcamera::logSetTarget(libcamera::LoggingTargetNone);
  }
  auto created = std::make_unique<libcamera::CameraManager>();
  if (const int failed = created->start(); failed != 0) {
    return SystemError("libcamera", "cannot start: " + std::string(std::strerror(-failed)),
                       "see whether udev runs and you may read the devices");
  }
  manager.reset(created.release(), StopManager);
  only.running = manager;
  only.exists = true;
  return manager;
}

std::optional<PixelFormat> PixelFormatOf(const libcamera::PixelFormat& theirs) {
  for (const Known& known : kKnown) {
    if (known.theirs == theirs) return known.ours;
  }
  return std::nullopt;
}

std::optional<libcamera::PixelFormat> LibcameraFormatOf(PixelFormat ours) {
  for (const Known& known : kKnown) {
    if (known.ours == ours) return known.theirs;
  }
  return std::nullopt;
}

std::vector<FormatDescription> LibcameraFormats(const libcamera::StreamFormats& formats) {
  std::vector<FormatDescription> descriptions;
  for (const libcamera::PixelFormat& theirs : formats.pixelformats()) {
    FormatDescription description;
    description.format = PixelFormatOf(theirs);
    description.name =
        description.format ? std::string(NameOf(*description.format)) : theirs.toString();
    for (const libcamera::Size& size : formats.sizes(theirs)) {
      description.sizes.push_back(
          {{static_cast<int>(size.width), static_cast<int>(size.height)}, {}});
    }
    std::stable_sort(description.sizes.begin(), description.sizes.end(),
                     [](const auto& a, const auto& b) {
                       return static_cast<double>(a.size.width) * a.size.height >
                              static_cast<double>(b.size.width) * b.size.height;
                     });
    descriptions.push_back(std::move(description));
  }
  return descriptions;
}

std::optional<V4l2Node> NodeBehind(libcamera::CameraManager& manager,
                                   const std::shared_ptr<libcamera::Camera>& camera) {
  const std::shared_ptr<V4l2Io> io = SystemV4l2Io();
  for (const V4l2Io::Node& each : io->Nodes()) {
    struct stat facts {};
    if (stat(each.path.c_str(), &facts) != 0 || manager.get(facts.st_rdev) != camera) continue;
    auto node = V4l2Node::Open(io, each.path);
    if (node) return *std::move(node);
  }
  return std::nullopt;
}

}  // namespace pleinair::devices
