#include "devices/cameras/v4l2/v4l2_io.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace pleinair::devices {
namespace {

namespace fs = std::filesystem;

std::string FirstLine(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

// The "device" of a USB video node is an interface; its parent has the serial number.
std::string SerialOf(const fs::path& video_class_folder) {
  std::error_code error;
  fs::path at = fs::canonical(video_class_folder / "device", error);
  if (error) return {};
  for (int up = 0; up < 2; ++up, at = at.parent_path()) {
    if (fs::exists(at / "serial", error)) return FirstLine(at / "serial");
  }
  return {};
}

class SystemIo : public V4l2Io {
 public:
  int Open(const std::string& node) override {
    const int fd = open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return fd < 0 ? -errno : fd;
  }

  void Close(int fd) override { close(fd); }

  int Ioctl(int fd, unsigned long request, void* argument) override {
    int result = 0;
    do {
      result = ioctl(fd, request, argument);
    } while (result < 0 && errno == EINTR);
    return result < 0 ? -errno : result;
  }

  void* Map(int fd, std::size_t length, std::size_t offset) override {
    void* address =
        mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, fd, static_cast<off_t>(offset));
    return address == MAP_FAILED ? nullptr : address;
  }

  void Unmap(void* address, std::size_t length) override { munmap(address, length); }

  int Poll(int fd, int wake_fd, int limit_ms) override {
    pollfd both[2] = {{fd, POLLIN, 0}, {wake_fd, POLLIN, 0}};
    const int ready = poll(both, 2, limit_ms);
    if (ready < 0) return errno == EINTR ? 0 : -errno;
    if ((both[1].revents & POLLIN) != 0) {
      std::uint64_t count = 0;
      // Drains the counter; the number of wakes does not matter.
      if (read(wake_fd, &count, sizeof count) < 0) return 0;
    }
    return both[0].revents;
  }

  std::vector<Node> Nodes() override {
    const fs::path folder = "/sys/class/video4linux";
    std::vector<std::pair<long, Node>> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename();
      if (!name.starts_with("video")) continue;
      found.emplace_back(std::strtol(name.c_str() + 5, nullptr, 10),
                         Node{"/dev/" + name, SerialOf(entry.path())});
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Node> nodes;
    for (auto& [number, node] : found) nodes.push_back(std::move(node));
    return nodes;
  }
};

}  // namespace

std::shared_ptr<V4l2Io> SystemV4l2Io() {
  static const std::shared_ptr<V4l2Io> kIo = std::make_shared<SystemIo>();
  return kIo;
}

}  // namespace pleinair::devices
