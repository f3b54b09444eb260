#include "app/check/spread_frames.h"

#include <utility>

#include "session/light_frames.h"

namespace pleinair::app {

SpreadFrames::SpreadFrames(std::unique_ptr<devices::FrameSource> all, std::size_t most)
    : all_(std::move(all)) {
  const std::optional<std::int64_t> count = all_->FrameCount();
  if (!count || !all_->CountsExactly()) return;
  wanted_.emplace();
  for (const std::size_t index : session::EvenlySpread(static_cast<std::size_t>(*count), most)) {
    wanted_->push_back(static_cast<std::int64_t>(index));
  }
}

SpreadFrames::SpreadFrames(std::unique_ptr<devices::FrameSource> all,
                           std::vector<std::int64_t> wanted)
    : all_(std::move(all)), wanted_(std::move(wanted)) {}

Result<std::optional<devices::Frame>> SpreadFrames::Next() {
  if (!wanted_) return all_->Next();
  if (next_ == wanted_->size()) return std::optional<devices::Frame>();
  const std::int64_t index = (*wanted_)[next_++];
  all_->SkipTo(index);
  for (;;) {
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame, all_->Next());
    if (!frame || frame->index >= index) return frame;
  }
}

std::optional<std::int64_t> SpreadFrames::FrameCount() const {
  if (!wanted_) return all_->FrameCount();
  return static_cast<std::int64_t>(wanted_->size());
}

void SpreadFrames::SkipTo(std::int64_t index) {
  if (!wanted_) return all_->SkipTo(index);
  while (next_ < wanted_->size() && (*wanted_)[next_] < index) ++next_;
}

}  // namespace pleinair::app
