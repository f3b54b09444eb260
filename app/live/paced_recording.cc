#include "app/live/paced_recording.h"

#include <thread>
#include <utility>

namespace pleinair::app {
namespace {

constexpr std::chrono::milliseconds kMaxLag{250};

}  // namespace

Result<std::unique_ptr<PacedRecording>> PacedRecording::Open(Opener opener,
                                                             const Options& options) {
  PLEINAIR_ASSIGN_OR_RETURN(auto recording, opener());
  return std::unique_ptr<PacedRecording>(
      new PacedRecording(std::move(opener), options, std::move(recording)));
}

Result<std::optional<devices::Frame>> PacedRecording::Next() {
  using Clock = std::chrono::steady_clock;
  auto frame = recording_->Next();
  if (frame && !*frame && options_.loop && next_index_ > 0) {
    PLEINAIR_ASSIGN_OR_RETURN(recording_, opener_());
    frame = recording_->Next();
    // The gap between two loops equals the last gap within the recording.
    if (frame && *frame) round_ns_ = last_ns_ + last_step_ns_ - (*frame)->timestamp_ns;
  }
  if (!frame || !*frame) return frame;
  if (options_.played) options_.played(next_index_, **frame);
  (*frame)->index = next_index_++;
  const std::int64_t stamp_ns =
      options_.rate_hz ? static_cast<std::int64_t>(static_cast<double>((*frame)->index) * 1e9 /
                                                   *options_.rate_hz)
                       : round_ns_ + (*frame)->timestamp_ns;
  // A recording of one frame keeps the initial step, so that each loop takes some time.
  if (stamp_ns > last_ns_) last_step_ns_ = stamp_ns - last_ns_;
  last_ns_ = stamp_ns;
  const std::chrono::nanoseconds since_start(stamp_ns);
  if (!start_) start_ = Clock::now() - since_start;
  // After slow reading, shift the schedule: the delay of frames must not accumulate.
  const auto late = Clock::now() - (*start_ + since_start);
  if (late > kMaxLag) *start_ += late;
  const Clock::time_point due = *start_ + since_start;
  std::this_thread::sleep_until(due);
  (*frame)->timestamp_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(due.time_since_epoch()).count();
  (*frame)->stamp_meaning = devices::StampMeaning::kArrival;
  return frame;
}

std::optional<std::int64_t> PacedRecording::FrameCount() const {
  return options_.loop ? std::nullopt : recording_->FrameCount();
}

}  // namespace pleinair::app
