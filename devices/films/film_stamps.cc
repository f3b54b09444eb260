#include "devices/films/film_stamps.h"

#include <algorithm>
#include <vector>

#include "base/quantile.h"

namespace pleinair::devices {
namespace {

constexpr const char* kRemux =
    "convert it in a video editor, or list its times in a recording.json (timestamps_s)";

}  // namespace

Result<FilmStamps> FilmStamps::Create(const std::vector<FilmPacket>& packets,
                                      FilmTimeBase time_base, const std::string& name) {
  if (time_base.numerator <= 0 || time_base.denominator <= 0) {
    return InputError(name, "has no unit of time", kRemux);
  }
  FilmStamps stamps;
  stamps.time_base_ = time_base;
  bool stored = true;
  for (const FilmPacket& packet : packets) {
    if (packet.is_hidden) continue;
    ++stamps.frames_;
    stored = stored && packet.shown.has_value();
    if (stored) stamps.ticks_.push_back(*packet.shown);
  }
  if (stamps.frames_ == 0) {
    return InputError(name, "holds no frames: it is empty or cut short", "get a whole copy of it");
  }
  if (!stored) {
    stamps.ticks_.clear();
    return stamps;
  }
  std::vector<std::int64_t>& ticks = stamps.ticks_;
  std::sort(ticks.begin(), ticks.end());
  if (std::adjacent_find(ticks.begin(), ticks.end()) != ticks.end()) {
    return InputError(name, "shows two frames at one time", kRemux);
  }
  const double span_s = (static_cast<double>(ticks.back()) - static_cast<double>(ticks.front())) *
                        time_base.numerator / time_base.denominator;
  if (span_s > kMaxSpan_s) {
    return InputError(name, "has time stamps that span years", kRemux);
  }
  for (const FilmPacket& packet : packets) {
    if (!packet.is_key || packet.is_hidden) continue;
    stamps.entries_.push_back({*stamps.FrameAt(*packet.shown),
                               std::min(*packet.shown, packet.decoded.value_or(*packet.shown))});
  }
  std::sort(stamps.entries_.begin(), stamps.entries_.end(),
            [](const Entry& a, const Entry& b) { return a.frame < b.frame; });
  return stamps;
}

std::int64_t FilmStamps::Nanoseconds(std::size_t frame) const {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  // No overflow: ticks × numerator are at most kMaxSpan_s × denominator, the rest is below it.
  const std::int64_t units = (ticks_.at(frame) - ticks_.front()) * time_base_.numerator;
  const std::int64_t seconds = units / time_base_.denominator;
  const std::int64_t rest = units % time_base_.denominator;
  return seconds * kSecond_ns +
         (rest * kSecond_ns + time_base_.denominator / 2) / time_base_.denominator;
}

std::optional<std::size_t> FilmStamps::FrameAt(std::int64_t ticks) const {
  const auto at = std::lower_bound(ticks_.begin(), ticks_.end(), ticks);
  if (at == ticks_.end() || *at != ticks) return std::nullopt;
  return static_cast<std::size_t>(at - ticks_.begin());
}

std::optional<FilmStamps::Entry> FilmStamps::EntryFor(std::size_t frame) const {
  const auto after =
      std::upper_bound(entries_.begin(), entries_.end(), frame,
                       [](std::size_t wanted, const Entry& entry) { return wanted < entry.frame; });
  return after == entries_.begin() ? std::nullopt : std::optional<Entry>(*(after - 1));
}

std::optional<double> FilmStamps::TypicalRate_hz() const {
  if (ticks_.size() < 2) return std::nullopt;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < ticks_.size(); ++i)
    intervals.push_back(static_cast<double>(ticks_[i] - ticks_[i - 1]));
  // The lower median: in a short film, a pause is not what is typical.
  return time_base_.denominator / (Quantile(intervals, 0.5) * time_base_.numerator);
}

double FilmStamps::start_s() const {
  if (ticks_.empty()) return 0.0;
  return static_cast<double>(ticks_.front()) * time_base_.numerator / time_base_.denominator;
}

}  // namespace pleinair::devices
