#include "devices/recordings/frame_range.h"

#include <utility>

namespace pleinair::devices {
namespace {

std::string Seconds(std::int64_t time_ns) {
  std::string text = std::to_string(static_cast<double>(time_ns) * 1e-9);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

class LimitedFrames final : public FrameSource {
 public:
  LimitedFrames(std::unique_ptr<FrameSource> frames, FrameRange range, std::string name)
      : frames_(std::move(frames)), range_(range), name_(std::move(name)) {
    if (range_.frame) {
      frames_->SkipTo(*range_.frame);
    } else if (range_.from_ns) {
      frames_->SkipTo(frames_->FirstFrameFrom(*range_.from_ns).value_or(0));
    }
  }

  Result<std::optional<Frame>> Next() override {
    while (!at_end_) {
      PLEINAIR_ASSIGN_OR_RETURN(std::optional<Frame> frame, frames_->Next());
      if (!frame || IsBehind(*frame)) break;
      if (!range_.Contains(frame->index, frame->timestamp_ns)) continue;
      at_end_ = range_.frame.has_value();
      is_empty_ = false;
      return frame;
    }
    at_end_ = true;
    if (is_empty_) return InputError(name_, "has no frame " + Wanted(), "choose frames it has");
    return std::nullopt;
  }

  void SkipTo(std::int64_t index) override { frames_->SkipTo(index); }

  std::optional<std::int64_t> FrameCount() const override {
    if (range_.frame) return 1;
    const std::optional<std::int64_t> all = frames_->FrameCount();
    if (!all) return std::nullopt;
    const auto first = range_.from_ns ? frames_->FirstFrameFrom(*range_.from_ns) : 0;
    const auto end = range_.until_ns ? frames_->FirstFrameFrom(*range_.until_ns + 1) : all;
    return first && end ? std::optional<std::int64_t>(*end - *first) : std::nullopt;
  }

  // Frames are counted within the range.
  bool CountsExactly() const override { return false; }

  std::optional<std::int64_t> FirstFrameFrom(std::int64_t timestamp_ns) const override {
    return frames_->FirstFrameFrom(timestamp_ns);
  }

 private:
  bool IsBehind(const Frame& frame) const {
    if (range_.frame) return frame.index > *range_.frame;
    return range_.until_ns && frame.timestamp_ns > *range_.until_ns;
  }

  std::string Wanted() const {
    if (range_.frame) {
      const std::optional<std::int64_t> all = frames_->FrameCount();
      return std::to_string(*range_.frame) +
             (all ? ": it has " + std::to_string(*all) + ", counted from 0" : std::string());
    }
    std::string text;
    if (range_.from_ns) text += "from " + Seconds(*range_.from_ns);
    if (range_.until_ns) text += (text.empty() ? "up to " : " to ") + Seconds(*range_.until_ns);
    return text;
  }

  std::unique_ptr<FrameSource> frames_;
  FrameRange range_;
  std::string name_;
  bool is_empty_ = true;
  bool at_end_ = false;
};

}  // namespace

std::unique_ptr<FrameSource> LimitFrames(std::unique_ptr<FrameSource> frames, FrameRange range,
                                         std::string name) {
  if (range.IsAll()) return frames;
  return std::make_unique<LimitedFrames>(std::move(frames), range, std::move(name));
}

}  // namespace pleinair::devices
