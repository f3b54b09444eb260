#include "compositor/photometry/changes/frame_brightness.h"

#include <utility>

#include "base/quantile.h"

namespace pleinair::compositor {
namespace {

// Rounds in which frames and probes are compared with each other's medians. They take back most of
// what errors from frame to frame have summed up.
constexpr int kRounds = 3;

struct Observation {
  std::size_t series, frame;
  double value;  // Logarithm of brightness.
};

/// Medians of `value - other[index of the other kind]`, by index.
std::vector<double> Medians(const std::vector<Observation>& observations, std::size_t count,
                            std::size_t Observation::*index, std::size_t Observation::*other_index,
                            const std::vector<double>& other) {
  std::vector<std::vector<double>> values(count);
  for (const Observation& one : observations) {
    values[one.*index].push_back(one.value - other[one.*other_index]);
  }
  std::vector<double> medians(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (!values[i].empty()) medians[i] = Median(values[i]);
  }
  return medians;
}

}  // namespace

std::vector<std::optional<double>> FrameBrightness(
    const std::vector<ProbeFit>& probes, std::size_t frame_count, std::size_t min_probes,
    const std::function<bool(const ProbeFit&)>& counts) {
  std::vector<std::vector<Observation>> frames(frame_count);
  std::vector<Observation> all;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (!counts(probes[i])) continue;
    for (const ProbeReading& reading : probes[i].readings()) {
      all.push_back({i, reading.frame, probes[i].Brightness(reading)});
      frames[reading.frame].push_back(all.back());
    }
  }
  std::vector<double> brightness(frame_count, 0.0);
  // A probe's last value, without the brightness of its frame.
  std::vector<std::optional<double>> last(probes.size());
  for (std::size_t t = 0; t < frame_count; ++t) {
    std::vector<double> values;
    for (const Observation& one : frames[t]) {
      if (last[one.series]) values.push_back(one.value - *last[one.series]);
    }
    brightness[t] = !values.empty() ? Median(std::move(values)) : t > 0 ? brightness[t - 1] : 0.0;
    for (const Observation& one : frames[t]) last[one.series] = one.value - brightness[t];
  }
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> of_probes =
        Medians(all, probes.size(), &Observation::series, &Observation::frame, brightness);
    brightness = Medians(all, frame_count, &Observation::frame, &Observation::series, of_probes);
  }
  std::vector<std::optional<double>> result(frame_count);
  for (std::size_t t = 0; t < frame_count; ++t) {
    if (frames[t].size() >= min_probes) result[t] = brightness[t];
  }
  return result;
}

}  // namespace pleinair::compositor
