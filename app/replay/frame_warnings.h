#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pleinair::app {

/// Gathers what a tracker says frame by frame, so that the user reads each thing once.
class FrameWarnings {
 public:
  /// What was said of one frame; frames come in order.
  void Add(std::int64_t frame_index, const std::vector<std::string>& warnings);

  /// "In 12 frames, the first being 3, …": in the order in which they first came up, the first few.
  std::vector<std::string> Sentences() const;

 private:
  struct Entry {
    std::string text;
    std::int64_t first_frame = 0, last_frame = 0, frames = 0;
  };
  std::vector<Entry> entries_;
};

}  // namespace pleinair::app
