#include "app/gain_history.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/quantile.h"

namespace pleinair::app {
namespace {

// Long enough to still a flickering reading, short enough to follow a camera's automatic exposure.
constexpr std::size_t kGainWindow = 15;
constexpr std::size_t kChangeWindow = 5;

/// Of the last `count` readings, or of all where there are fewer.
LinearRgb MedianOfLast(const std::deque<LinearRgb>& readings, std::size_t count) {
  count = std::min(count, readings.size());
  std::vector<double> values(count);
  const auto median = [&](double LinearRgb::*channel) {
    std::transform(readings.end() - static_cast<std::ptrdiff_t>(count), readings.end(),
                   values.begin(), [&](const LinearRgb& reading) { return reading.*channel; });
    return Median(values);
  };
  return {median(&LinearRgb::r), median(&LinearRgb::g), median(&LinearRgb::b)};
}

}  // namespace

void GainHistory::Add(const LinearRgb& gain) {
  recent_.push_back(gain);
  if (recent_.size() > kGainWindow) recent_.pop_front();
  if (recent_.size() < kChangeWindow) return;
  const LinearRgb now = MedianOfLast(recent_, kChangeWindow);
  if (!(std::min({now.r, now.g, now.b}) > 0.0)) return;
  if (!(most_.r > 0.0)) least_ = most_ = now;
  least_ = {std::min(least_.r, now.r), std::min(least_.g, now.g), std::min(least_.b, now.b)};
  most_ = {std::max(most_.r, now.r), std::max(most_.g, now.g), std::max(most_.b, now.b)};
}

LinearRgb GainHistory::Gain() const { return MedianOfLast(recent_, kGainWindow); }

double GainHistory::Change() const {
  if (!(least_.r > 0.0)) return 1.0;
  const LinearRgb change = most_ / least_;
  return std::max({change.r, change.g, change.b});
}

}  // namespace pleinair::app
