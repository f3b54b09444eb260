#include "devices/cameras/libcamera/libcamera_manager.h"

#include <libcamera/formats.h>
#include <libcamera/logging.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "devices/cameras/libcamera/uevent_sockets.h"

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

/// The only manager, and a way to wait until the previous one is destroyed.
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
  // Not kept longer than its users, because it has only the cameras that were connected when it
  // started.
  OnlyManager& only = TheOnlyOne();
  std::unique_lock lock(only.mutex);
  std::shared_ptr<libcamera::CameraManager> manager;
  only.gone.wait(lock, [&] { return (manager = only.running.lock()) || !only.exists; });
  if (manager) return manager;
  // Our errors contain what the user needs; libcamera's log can be enabled by its own variable.
  if (std::getenv("LIBCAMERA_LOG_LEVELS") == nullptr) {
    libcamera::logSetTarget(libcamera::LoggingTargetNone);
  }
  auto created = std::make_unique<libcamera::CameraManager>();
  const std::vector<int> of_others = UeventSockets();
  if (const int failed = created->start(); failed != 0) {
    return SystemError("libcamera", "cannot start: " + std::string(std::strerror(-failed)),
                       "check that udev runs and that you may read the devices");
  }
  // libcamera 0.0.3 crashes on some orders of device events: DeviceEnumeratorUdev::addV4L2Device
  // leaves freed devices in devMap_. It reads them when a camera gets the same number again and its
  // video node is announced before its media node.
  for (const int socket : UeventSockets()) {
    const bool is_new = std::find(of_others.begin(), of_others.end(), socket) == of_others.end();
    if (is_new && !MuteSocket(socket)) {
      created->stop();
      return SystemError("libcamera", "cannot disable its hotplug monitoring",
                         "use the camera through V4L2");
    }
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

namespace {

struct VideoNode {
  std::string path;
  dev_t number;
};

std::vector<VideoNode> VideoNodesOf(libcamera::CameraManager& manager,
                                    const std::shared_ptr<libcamera::Camera>& camera) {
  std::vector<VideoNode> nodes;
  for (const V4l2Io::Node& each : SystemV4l2Io()->Nodes()) {
    struct stat facts {};
    if (stat(each.path.c_str(), &facts) != 0 || manager.get(facts.st_rdev) != camera) continue;
    nodes.push_back({each.path, facts.st_rdev});
  }
  return nodes;
}

}  // namespace

std::optional<V4l2Node> NodeBehind(libcamera::CameraManager& manager,
                                   const std::shared_ptr<libcamera::Camera>& camera) {
  for (const VideoNode& each : VideoNodesOf(manager, camera)) {
    auto node = V4l2Node::Open(SystemV4l2Io(), each.path);
    if (node) return *std::move(node);
  }
  return std::nullopt;
}

std::optional<std::string> KernelEntryOf(libcamera::CameraManager& manager,
                                         const std::shared_ptr<libcamera::Camera>& camera) {
  const std::vector<VideoNode> nodes = VideoNodesOf(manager, camera);
  if (nodes.empty()) return std::nullopt;
  const dev_t number = nodes.front().number;
  return "/sys/dev/char/" + std::to_string(major(number)) + ":" + std::to_string(minor(number));
}

}  // namespace pleinair::devices
