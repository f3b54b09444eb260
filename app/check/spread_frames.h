#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "devices/frame_source.h"

namespace pleinair::app {

/// Samples frames of a recording. They keep their own indices and time stamps.
/// FrameCount() is their number.
class SpreadFrames : public devices::FrameSource {
 public:
  /// At most `most` frames, evenly spread; all where the number of frames is not known.
  SpreadFrames(std::unique_ptr<devices::FrameSource> all, std::size_t most);
  /// The frames with these indices, which ascend.
  SpreadFrames(std::unique_ptr<devices::FrameSource> all, std::vector<std::int64_t> wanted);

  Result<std::optional<devices::Frame>> Next() override;
  std::optional<std::int64_t> FrameCount() const override;
  void SkipTo(std::int64_t index) override;

 private:
  std::unique_ptr<devices::FrameSource> all_;
  std::optional<std::vector<std::int64_t>> wanted_;
  std::size_t next_ = 0;  // Index in wanted_.
};

}  // namespace pleinair::app
