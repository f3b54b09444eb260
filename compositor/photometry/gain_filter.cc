#include "compositor/photometry/gain_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// Long enough to still a flickering reading, short enough to follow a camera's automatic exposure.
constexpr std::size_t kGainWindow = 15;
constexpr std::size_t kChangeWindow = 5;

// Standard deviation over the median deviation, and a median's standard error over a mean's: both
// of a normal distribution.
constexpr double kSigmaOverMad = 1.4826, kMedianError = 1.2533;

}  // namespace

template <typename Value>
LinearRgb GainHistory::MedianOfLast(std::size_t count, const Value& value) const {
  count = std::min(count, recent_.size());
  std::vector<LinearRgb> all(count);
  std::transform(recent_.end() - static_cast<std::ptrdiff_t>(count), recent_.end(), all.begin(),
                 value);
  std::vector<double> values(count);
  const auto median = [&](double LinearRgb::*channel) {
    std::transform(all.begin(), all.end(), values.begin(),
                   [&](const LinearRgb& one) { return one.*channel; });
    return Median(values);
  };
  return {median(&LinearRgb::r), median(&LinearRgb::g), median(&LinearRgb::b)};
}

void GainHistory::Add(const LinearRgb& gain, const LinearRgb& error) {
  recent_.push_back({gain, error});
  if (recent_.size() > kGainWindow) recent_.pop_front();
  if (recent_.size() < kChangeWindow) return;
  const LinearRgb now = MedianOfLast(kChangeWindow, std::mem_fn(&Reading::gain));
  if (!(std::min({now.r, now.g, now.b}) > 0.0)) return;
  if (!(most_.r > 0.0)) least_ = most_ = now;
  least_ = {std::min(least_.r, now.r), std::min(least_.g, now.g), std::min(least_.b, now.b)};
  most_ = {std::max(most_.r, now.r), std::max(most_.g, now.g), std::max(most_.b, now.b)};
}

LinearRgb GainHistory::Gain() const {
  return MedianOfLast(kGainWindow, std::mem_fn(&Reading::gain));
}

LinearRgb GainHistory::Error() const {
  const LinearRgb gain = Gain();
  const LinearRgb own = MedianOfLast(kGainWindow, std::mem_fn(&Reading::error));
  const LinearRgb deviation = MedianOfLast(kGainWindow, [&](const Reading& reading) {
    const LinearRgb off = reading.gain / gain;
    return LinearRgb{std::abs(off.r - 1.0), std::abs(off.g - 1.0), std::abs(off.b - 1.0)};
  });
  const LinearRgb among =
      deviation * (kSigmaOverMad * kMedianError / std::sqrt(static_cast<double>(recent_.size())));
  return {std::hypot(own.r, among.r), std::hypot(own.g, among.g), std::hypot(own.b, among.b)};
}

double GainHistory::Change() const {
  if (!(least_.r > 0.0)) return 1.0;
  const LinearRgb change = most_ / least_;
  return std::max({change.r, change.g, change.b});
}

}  // namespace pleinair::compositor
