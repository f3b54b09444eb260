#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pleinair::devices {

/// The system calls that a V4L2 device needs, as an interface, so that tests can simulate a driver.
/// Each returns the system call's result, or the negative errno on failure.
class V4l2Io {
 public:
  virtual ~V4l2Io() = default;
  virtual int Open(const std::string& node) = 0;
  virtual void Close(int fd) = 0;
  virtual int Ioctl(int fd, unsigned long request, void* argument) = 0;
  /// Returns null on failure.
  virtual void* Map(int fd, std::size_t length, std::size_t offset) = 0;
  virtual void Unmap(void* address, std::size_t length) = 0;
  /// Waits for `fd` or `wake_fd` (which is drained). Returns poll()'s revents of `fd`; 0 on timeout
  /// or when woken.
  virtual int Poll(int fd, int wake_fd, int limit_ms) = 0;
  /// A video node, with its properties from sysfs.
  struct Node {
    std::string path;
    std::string serial;  ///< Of the USB device it belongs to; empty if there is none.
  };
  virtual std::vector<Node> Nodes() = 0;
};

/// The implementation by real system calls.
std::shared_ptr<V4l2Io> SystemV4l2Io();

}  // namespace pleinair::devices
