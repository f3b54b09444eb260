#include "app/replay/frame_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pleinair::app {
namespace {

// A value that differs in every frame must not fill the report.
constexpr std::size_t kMaxKinds = 8;

}  // namespace

void FrameWarnings::Add(std::int64_t frame_index, const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) {
    auto entry = std::find_if(entries_.begin(), entries_.end(),
                              [&](const Entry& other) { return other.text == text; });
    if (entry == entries_.end()) {
      if (entries_.size() == kMaxKinds) continue;
      entry = entries_.insert(entries_.end(), Entry{text, frame_index, frame_index, 1});
    } else if (entry->last_frame != frame_index) {
      entry->last_frame = frame_index;
      ++entry->frames;
    }
  }
}

std::vector<std::string> FrameWarnings::Sentences() const {
  std::vector<std::string> sentences;
  for (const Entry& entry : entries_) {
    sentences.push_back(entry.frames == 1
                            ? fmt::format("In frame {} {}.", entry.first_frame, entry.text)
                            : fmt::format("In {} frames, the first being {}, {}.", entry.frames,
                                          entry.first_frame, entry.text));
  }
  return sentences;
}

}  // namespace pleinair::app
