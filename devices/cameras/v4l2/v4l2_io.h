#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pleinair::devices {

/// The few system calls that a V4L2 device needs, so that tests can play a driver. Each gives what
/// the system call gives, and the negative errno where that fails.
class V4l2Io {
 public:
  virtual ~V4l2Io() = default;
  virtual int Open(const std::string& node) = 0;
  virtual void Close(int fd) = 0;
  virtual int Ioctl(int fd, unsigned long request, void* argument) = 0;
  /// Null on failure.
  virtual void* Map(int fd, std::size_t length, std::size_t offset) = 0;
  virtual void Unmap(void* address, std::size_t length) = 0;
  /// Waits for `fd` or `wake_fd` (drained here); gives poll()'s revents of `fd`, 0 where the time
  /// is over or the other one woke.
  virtual int Poll(int fd, int wake_fd, int limit_ms) = 0;
  /// Every video node there is and what sysfs knows of it.
  struct Node {
    std::string path;
    std::string serial;  ///< Of the USB device it belongs to; empty where there is none.
  };
  virtual std::vector<Node> Nodes() = 0;
};

/// The real thing.
std::shared_ptr<V4l2Io> SystemV4l2Io();

}  // namespace pleinair::devices
