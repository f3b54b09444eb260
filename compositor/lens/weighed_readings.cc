#include "compositor/lens/weighed_readings.h"

#include <algorithm>
#include <map>

namespace pleinair::compositor {
namespace {

/// Variance of a reading that the next reading at the same distance shares: edges and pixel grid
/// are the same there.
double SharedVariance(double blur_px) {
  const double shared_px = 0.01 + 0.005 * blur_px;
  return shared_px * shared_px;
}

/// How many readings lie at about the distance of each.
std::vector<double> Neighbours(std::span<const BlurReading> readings) {
  constexpr double kBin = 0.03;  // A share of the distance.
  std::map<long, double> bins;
  const auto bin = [](const BlurReading& r) { return std::lround(std::log(r.dioptres) / kBin); };
  for (const BlurReading& reading : readings) bins[bin(reading)] += 1.0;
  std::vector<double> count(readings.size());
  std::transform(readings.begin(), readings.end(), count.begin(),
                 [&](const BlurReading& reading) { return bins[bin(reading)]; });
  return count;
}

}  // namespace

WeighedReadings::WeighedReadings(std::span<const BlurReading> all)
    : readings(all), neighbours(Neighbours(all)), weights(all.size()), is_moved(all.size()) {}

double WeighedReadings::Variance(std::size_t i, double squared_blur) const {
  const double own = readings[i].error_px * readings[i].error_px;
  return 4.0 * squared_blur * (own + neighbours[i] * SharedVariance(std::sqrt(squared_blur)));
}

void WeighedReadings::WeighBy(const BlurParabola* fitted) {
  constexpr double kHuber = 1.345;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double read = readings[i].blur_px * readings[i].blur_px;
    const double expected = fitted ? fitted->At(readings[i]) : read;
    const double variance = Variance(i, std::max(expected, 0.25 * read));
    const double off = fitted ? std::fabs(read - expected) / std::sqrt(variance) : 0.0;
    weights[i] = is_moved[i] ? 0.0 : std::min(1.0, kHuber / std::max(off, 1e-9)) / variance;
  }
}

double WeighedReadings::ReducedChiSquared(const BlurParabola& fitted, int unknowns) const {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!(weights[i] > 0.0)) continue;
    const double off = readings[i].blur_px * readings[i].blur_px - fitted.At(readings[i]);
    sum += weights[i] * off * off;
    count += 1.0;
  }
  return std::max(1.0, sum / std::max(1.0, count - unknowns));
}

std::size_t WeighedReadings::CountUsed() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(weights, [](double weight) { return weight > 0.0; }));
}

std::vector<double> WeightsWithout(const WeighedReadings& weighed, int group) {
  const std::span<const BlurReading> readings = weighed.readings;
  std::vector<std::int64_t> frames;
  frames.reserve(readings.size());
  for (const BlurReading& reading : readings) {
    if (frames.empty() || frames.back() != reading.frame_index) {
      frames.push_back(reading.frame_index);
    }
  }
  const auto begin_of = [&](int g) {
    const std::size_t i = frames.size() * static_cast<std::size_t>(g) / kJackknifeGroups;
    return i < frames.size() ? frames[i] : std::numeric_limits<std::int64_t>::max();
  };
  std::vector<double> weights(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const bool is_out =
        readings[i].frame_index >= begin_of(group) && readings[i].frame_index < begin_of(group + 1);
    weights[i] = is_out ? 0.0 : weighed.weights[i];
  }
  return weights;
}

}  // namespace pleinair::compositor
