#include "app/live/paced_recording.h"

#include <thread>
#include <utility>

namespace pleinair::app {

Result<std::optional<devices::Frame>> PacedRecording::Next() {
  using Clock = std::chrono::steady_clock;
  auto frame = recording_->Next();
  if (!frame || !*frame) return frame;
  const std::chrono::nanoseconds since_start((*frame)->timestamp_ns);
  if (!start_) start_ = Clock::now() - since_start;
  const Clock::time_point due = *start_ + since_start;
  std::this_thread::sleep_until(due);
  (*frame)->timestamp_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(due.time_since_epoch()).count();
  (*frame)->stamp_meaning = devices::StampMeaning::kArrival;
  return frame;
}

}  // namespace pleinair::app
