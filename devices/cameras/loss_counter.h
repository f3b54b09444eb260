#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "devices/frame.h"

namespace pleinair::devices {

/// Counts the frames that were lost before each frame, from the driver's frame numbers and time
/// stamps. A gap in the numbers counts by number. If the numbers are consecutive but the time
/// stamps jump by two or more usual periods (running median, because cameras slow down in the
/// dark), the loss counts by time. A pause longer than `pause_ns` is a stall, not a loss.
class LossCounter {
 public:
  explicit LossCounter(std::int64_t pause_ns) : pause_ns_(pause_ns) {}

  FrameLoss Add(std::int64_t number, std::int64_t timestamp_ns);

  /// The usual time between frames; 0 until enough frames have been measured.
  std::int64_t period_ns() const { return period_ns_; }

 private:
  static constexpr int kWindow = 9;

  std::int64_t pause_ns_;
  bool has_last_ = false;
  std::int64_t last_number_ = 0;
  std::int64_t last_stamp_ns_ = 0;
  std::array<std::int64_t, kWindow> periods_ns_{};
  int periods_ = 0;
  std::int64_t period_ns_ = 0;
};

}  // namespace pleinair::devices
