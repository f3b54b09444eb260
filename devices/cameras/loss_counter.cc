#include "devices/cameras/loss_counter.h"

#include <algorithm>
#include <cmath>

namespace pleinair::devices {
namespace {

constexpr int kEnough = 5;
// Slightly more than halfway between one and two periods, because exposures vary.
constexpr double kJump = 1.6;

}  // namespace

FrameLoss LossCounter::Add(std::int64_t number, std::int64_t timestamp_ns) {
  FrameLoss loss;
  const std::int64_t steps = number - last_number_;
  const std::int64_t passed_ns = timestamp_ns - last_stamp_ns_;
  const bool follows = has_last_ && steps > 0 && passed_ns > 0 && passed_ns < pause_ns_;
  if (follows) {
    loss.by_number = static_cast<int>(steps - 1);
    const double each_ns = static_cast<double>(passed_ns) / static_cast<double>(steps);
    if (steps == 1 && period_ns_ > 0 && each_ns > kJump * static_cast<double>(period_ns_)) {
      loss.by_time =
          std::max(0, static_cast<int>(std::lround(each_ns / static_cast<double>(period_ns_))) - 1);
    }
    periods_ns_[static_cast<std::size_t>(periods_ % kWindow)] = std::llround(each_ns);
    ++periods_;
    if (periods_ >= kEnough) {
      auto sorted = periods_ns_;
      const int count = std::min(periods_, kWindow);
      std::nth_element(sorted.begin(), sorted.begin() + count / 2, sorted.begin() + count);
      period_ns_ = sorted[static_cast<std::size_t>(count / 2)];
    }
  }
  has_last_ = true;
  last_number_ = number;
  last_stamp_ns_ = timestamp_ns;
  return loss;
}

}  // namespace pleinair::devices
