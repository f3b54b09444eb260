#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/cameras/camera.h"
#include "devices/cameras/camera_uri.h"
#include "devices/cameras/v4l2/v4l2_io.h"

namespace pleinair::devices {

/// An open node that can capture. Move-only; closes itself.
class V4l2Node {
 public:
  /// Errors: not found, no permission, not a camera (an output, a metadata node, or multi-planar
  /// only).
  static Result<V4l2Node> Open(std::shared_ptr<V4l2Io> io, const std::string& path);
  V4l2Node(V4l2Node&& other) noexcept;
  V4l2Node& operator=(V4l2Node&& other) noexcept;
  ~V4l2Node();

  /// As ioctl(); negative errno on failure.
  int Control(unsigned long request, void* argument) const {
    return io_->Ioctl(fd_, request, argument);
  }
  int fd() const { return fd_; }
  V4l2Io& io() const { return *io_; }
  const std::string& path() const { return path_; }
  const std::string& name() const { return name_; }
  const std::string& driver() const { return driver_; }
  const std::string& bus() const { return bus_; }

  std::vector<FormatDescription> Formats() const;

 private:
  V4l2Node() = default;

  std::shared_ptr<V4l2Io> io_;
  int fd_ = -1;
  std::string path_, name_, driver_, bus_;
};

/// The node that a URI identifies now: the first that can capture, because USB cameras also have
/// metadata nodes. Error: not found.
Result<V4l2Io::Node> FindV4l2Node(const std::shared_ptr<V4l2Io>& io, const CameraUri& uri);

/// Stable identity: the serial number if there is one, else the bus position. Two cameras with the
/// same serial number (cheap ones all have "0001") are identified by bus position.
CameraUri V4l2Identity(const std::shared_ptr<V4l2Io>& io, const V4l2Node& node);

std::vector<CameraDescription> ListV4l2Cameras(const std::shared_ptr<V4l2Io>& io);

}  // namespace pleinair::devices
