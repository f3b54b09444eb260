#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "devices/frame_source.h"

namespace pleinair::tests {

/// All frames to the end of a film.
inline std::vector<devices::Frame> ReadAll(devices::FrameSource& film) {
  std::vector<devices::Frame> frames;
  for (;;) {
    auto frame = film.Next();
    if (!frame) {
      ADD_FAILURE() << frame.error().Message();
      return frames;
    }
    if (!*frame) return frames;
    frames.push_back(**std::move(frame));
  }
}

}  // namespace pleinair::tests
