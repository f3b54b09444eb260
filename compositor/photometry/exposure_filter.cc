#include "compositor/photometry/exposure_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// Long enough to smooth a flickering estimate, short enough to follow a camera's automatic
// exposure.
constexpr std::size_t kExposureWindow = 15;
constexpr std::size_t kChangeWindow = 5;

// For a normal distribution: standard deviation over median absolute deviation, and standard error
// of the median over that of the mean.
constexpr double kSigmaOverMad = 1.4826, kMedianError = 1.2533;

}  // namespace

template <typename Value>
LinearRgb ExposureFilter::MedianOfLast(std::size_t count, const Value& value) const {
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

void ExposureFilter::Add(const LinearRgb& exposure_scale, const LinearRgb& error) {
  recent_.push_back({exposure_scale, error});
  if (recent_.size() > kExposureWindow) recent_.pop_front();
  if (recent_.size() < kChangeWindow) return;
  const LinearRgb now = MedianOfLast(kChangeWindow, std::mem_fn(&Estimate::exposure_scale));
  if (!(std::min({now.r, now.g, now.b}) > 0.0)) return;
  if (!(max_.r > 0.0)) min_ = max_ = now;
  min_ = {std::min(min_.r, now.r), std::min(min_.g, now.g), std::min(min_.b, now.b)};
  max_ = {std::max(max_.r, now.r), std::max(max_.g, now.g), std::max(max_.b, now.b)};
}

LinearRgb ExposureFilter::ExposureScale() const {
  return MedianOfLast(kExposureWindow, std::mem_fn(&Estimate::exposure_scale));
}

LinearRgb ExposureFilter::Error() const {
  const LinearRgb exposure_scale = ExposureScale();
  const LinearRgb own = MedianOfLast(kExposureWindow, std::mem_fn(&Estimate::error));
  const LinearRgb deviation = MedianOfLast(kExposureWindow, [&](const Estimate& estimate) {
    const LinearRgb off = estimate.exposure_scale / exposure_scale;
    return LinearRgb{std::abs(off.r - 1.0), std::abs(off.g - 1.0), std::abs(off.b - 1.0)};
  });
  const LinearRgb among =
      deviation * (kSigmaOverMad * kMedianError / std::sqrt(static_cast<double>(recent_.size())));
  return {std::hypot(own.r, among.r), std::hypot(own.g, among.g), std::hypot(own.b, among.b)};
}

double ExposureFilter::Change() const {
  if (!(min_.r > 0.0)) return 1.0;
  const LinearRgb change = max_ / min_;
  return std::max({change.r, change.g, change.b});
}

}  // namespace pleinair::compositor
