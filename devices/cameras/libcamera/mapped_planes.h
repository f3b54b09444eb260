#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <libcamera/framebuffer.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pleinair::devices {

/// Read-only memory mapping of the planes of one buffer.
class MappedPlanes {
 public:
  MappedPlanes() = default;
  MappedPlanes(MappedPlanes&& other) noexcept : maps_(std::exchange(other.maps_, {})) {}
  MappedPlanes& operator=(MappedPlanes&&) = delete;
  ~MappedPlanes() {
    for (const Map& map : maps_) munmap(map.start, map.length);
  }

  /// Returns false and sets errno if the plane cannot be mapped.
  bool Add(const libcamera::FrameBuffer::Plane& plane) {
    const std::size_t length = plane.offset + static_cast<std::size_t>(plane.length);
    void* start = mmap(nullptr, length, PROT_READ, MAP_SHARED, plane.fd.get(), 0);
    if (start == MAP_FAILED) return false;
    maps_.push_back({start, length, plane.offset});
    return true;
  }

  std::span<const std::uint8_t> Plane(std::size_t i) const {
    const auto* start = static_cast<const std::uint8_t*>(maps_[i].start);
    return {start + maps_[i].offset, maps_[i].length - maps_[i].offset};
  }
  std::size_t size() const { return maps_.size(); }

 private:
  struct Map {
    void* start;
    std::size_t length, offset;
  };
  std::vector<Map> maps_;
};

}  // namespace pleinair::devices
