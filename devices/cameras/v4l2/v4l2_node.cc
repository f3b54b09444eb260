#include "devices/cameras/v4l2/v4l2_node.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "devices/cameras/v4l2/v4l2_controls.h"
#include "devices/cameras/v4l2/v4l2_status.h"

namespace pleinair::devices {
namespace {

template <std::size_t N>
std::string Text(const __u8 (&bytes)[N]) {
  const char* text = reinterpret_cast<const char*>(bytes);
  return {text, strnlen(text, N)};
}

// Guards against drivers whose enumeration never ends.
constexpr __u32 kMaxEntries = 256;

std::vector<double> RatesOf(const V4l2Node& node, __u32 four_cc, ImageSize size) {
  std::vector<double> rates;
  for (__u32 i = 0; i < kMaxEntries; ++i) {
    v4l2_frmivalenum interval{};
    interval.index = i;
    interval.pixel_format = four_cc;
    interval.width = static_cast<__u32>(size.width);
    interval.height = static_cast<__u32>(size.height);
    if (node.Control(VIDIOC_ENUM_FRAMEINTERVALS, &interval) < 0) break;
    const bool discrete = interval.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    const v4l2_fract& shortest = discrete ? interval.discrete : interval.stepwise.min;
    const v4l2_fract& longest = discrete ? interval.discrete : interval.stepwise.max;
    for (const v4l2_fract* time : {&shortest, &longest}) {
      if (time->numerator == 0) continue;
      rates.push_back(static_cast<double>(time->denominator) / time->numerator);
    }
    if (!discrete) break;
  }
  std::sort(rates.rbegin(), rates.rend());
  rates.erase(std::unique(rates.begin(), rates.end()), rates.end());
  return rates;
}

std::vector<FormatDescription::Size> SizesOf(const V4l2Node& node, __u32 four_cc) {
  std::vector<FormatDescription::Size> sizes;
  const auto add = [&](__u32 width, __u32 height) {
    const ImageSize size{static_cast<int>(width), static_cast<int>(height)};
    sizes.push_back({size, RatesOf(node, four_cc, size)});
  };
  for (__u32 i = 0; i < kMaxEntries; ++i) {
    v4l2_frmsizeenum entry{};
    entry.index = i;
    entry.pixel_format = four_cc;
    if (node.Control(VIDIOC_ENUM_FRAMESIZES, &entry) < 0) break;
    if (entry.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      add(entry.discrete.width, entry.discrete.height);
      continue;
    }
    // Any size between two limits: list the limits.
    add(entry.stepwise.max_width, entry.stepwise.max_height);
    add(entry.stepwise.min_width, entry.stepwise.min_height);
    break;
  }
  std::stable_sort(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) {
    return static_cast<double>(a.size.width) * a.size.height >
           static_cast<double>(b.size.width) * b.size.height;
  });
  return sizes;
}

CameraUri NodeUri(const std::string& path) {
  return {CameraUri::Backend::kV4l2, CameraUri::Key::kNode, path};
}

}  // namespace

Result<V4l2Node> V4l2Node::Open(std::shared_ptr<V4l2Io> io, const std::string& path) {
  V4l2Node node;
  node.io_ = std::move(io);
  node.path_ = path;
  node.fd_ = node.io_->Open(path);
  if (node.fd_ < 0) return tl::make_unexpected(V4l2Error(path, "cannot open", -node.fd_));
  v4l2_capability capability{};
  const int result = node.Control(VIDIOC_QUERYCAP, &capability);
  if (result < 0)
    return tl::make_unexpected(V4l2Error(path, "cannot query its capabilities", -result));
  const __u32 can = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps
                                                                          : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) {
    const bool planar = (can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0;
    return InputError(path,
                      planar ? "has only V4L2's multi-planar interface, which is not supported"
                             : "is no camera: it cannot stream images",
                      planar ? "use it through libcamera: 'pleinair devices' lists its name"
                             : "'pleinair devices' lists cameras");
  }
  node.name_ = Text(capability.card);
  node.driver_ = Text(capability.driver);
  node.bus_ = Text(capability.bus_info);
  return node;
}

V4l2Node::V4l2Node(V4l2Node&& other) noexcept { *this = std::move(other); }

V4l2Node& V4l2Node::operator=(V4l2Node&& other) noexcept {
  std::swap(io_, other.io_);
  std::swap(fd_, other.fd_);
  std::swap(path_, other.path_);
  std::swap(name_, other.name_);
  std::swap(driver_, other.driver_);
  std::swap(bus_, other.bus_);
  return *this;
}

V4l2Node::~V4l2Node() {
  if (fd_ >= 0) io_->Close(fd_);
}

std::vector<FormatDescription> V4l2Node::Formats() const {
  std::vector<FormatDescription> formats;
  for (__u32 i = 0; i < kMaxEntries; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (Control(VIDIOC_ENUM_FMT, &entry) < 0) break;
    formats.push_back({FourCcName(entry.pixelformat), PixelFormatOf(entry.pixelformat),
                       SizesOf(*this, entry.pixelformat)});
  }
  return formats;
}

CameraUri V4l2Identity(const std::shared_ptr<V4l2Io>& io, const V4l2Node& node) {
  std::string serial;
  std::vector<V4l2Io::Node> nodes = io->Nodes();
  for (const V4l2Io::Node& each : nodes) {
    if (each.path == node.path()) serial = each.serial;
  }
  if (serial.empty()) return {CameraUri::Backend::kV4l2, CameraUri::Key::kBus, node.bus()};
  for (const V4l2Io::Node& each : nodes) {
    if (each.path == node.path() || each.serial != serial) continue;
    const auto other = V4l2Node::Open(io, each.path);
    if (other && other->bus() != node.bus()) {
      return {CameraUri::Backend::kV4l2, CameraUri::Key::kBus, node.bus()};
    }
  }
  return {CameraUri::Backend::kV4l2, CameraUri::Key::kSerial, serial};
}

Result<V4l2Io::Node> FindV4l2Node(const std::shared_ptr<V4l2Io>& io, const CameraUri& uri) {
  if (uri.key == CameraUri::Key::kNode) return V4l2Io::Node{uri.value, {}};
  for (const V4l2Io::Node& candidate : io->Nodes()) {
    if (uri.key == CameraUri::Key::kSerial && candidate.serial != uri.value) continue;
    const auto node = V4l2Node::Open(io, candidate.path);
    if (!node || (uri.key == CameraUri::Key::kBus && node->bus() != uri.value)) continue;
    return candidate;
  }
  return InputError(uri.ToString(), "there is no such camera",
                    "plug it in; 'pleinair devices' lists what is there");
}

std::vector<CameraDescription> ListV4l2Cameras(const std::shared_ptr<V4l2Io>& io) {
  std::vector<CameraDescription> cameras;
  for (const V4l2Io::Node& candidate : io->Nodes()) {
    CameraDescription camera;
    camera.node = NodeUri(candidate.path).ToString();
    camera.serial = candidate.serial;
    const auto node = V4l2Node::Open(io, candidate.path);
    if (!node) {
      // Nodes that are not cameras are skipped; cameras without permission or busy ones are listed
      // with the reason.
      const int fd = io->Open(candidate.path);
      if (fd >= 0) {
        io->Close(fd);
        continue;
      }
      if (fd == -ENOENT || fd == -ENODEV || fd == -ENXIO) continue;
      camera.uri = camera.node;
      camera.trouble = node.error().what + "; " + node.error().remedy;
      cameras.push_back(std::move(camera));
      continue;
    }
    camera.uri = V4l2Identity(io, *node).ToString();
    camera.name = node->name();
    camera.driver = node->driver();
    camera.bus = node->bus();
    camera.formats = node->Formats();
    camera.controls = V4l2Controls(*node);
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

}  // namespace pleinair::devices
