#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pleinair::app {

/// Collects a tracker's warnings frame by frame, so that the user reads each one once.
class FrameWarnings {
 public:
  /// Adds the warnings of one frame. Frames must come in order.
  void Add(std::int64_t frame_index, const std::vector<std::string>& warnings);

  /// "In 12 frames, the first being 3, …": in order of first occurrence, the first few only.
  std::vector<std::string> Sentences() const;

 private:
  struct Entry {
    std::string text;
    std::int64_t first_frame = 0, last_frame = 0, frames = 0;
  };
  std::vector<Entry> entries_;
};

}  // namespace pleinair::app
