#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "devices/frame.h"

namespace pleinair::devices {

/// Tells from drivers' numbers and stamps how many frames are missing before each. A jump of the
/// numbers counts by number; where the numbers go on but the stamps jump by two or more of the
/// usual periods (the running median, because cameras slow down in the dark), the rest counts by
/// time. A pause longer than `pause_ns` is a stall, no loss.
class LossCounter {
 public:
  explicit LossCounter(std::int64_t pause_ns) : pause_ns_(pause_ns) {}

  FrameLoss Add(std::int64_t number, std::int64_t timestamp_ns);

  /// The usual time between frames; 0 before there are enough of them.
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
