#include "compositor/photometry/changes/light_start.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/quantile.h"
#include "compositor/photometry/changes/frame_brightness.h"

namespace pleinair::compositor {
namespace {

// Quantile of the frames' depths of shadow that counts as the full sun's, and how much less,
// logarithmic, is still full sun.
constexpr double kDeepest = 0.9, kAsDeep = 0.1;
// Difference of the sun's shares on the two kinds of probes that tells sun and sky apart, and the
// least of either.
constexpr double kMinContrast = 0.2, kLeastLight = 0.02;

using Brightness = std::vector<std::optional<double>>;

std::size_t Shown(const Brightness& brightness) {
  return static_cast<std::size_t>(std::count_if(brightness.begin(), brightness.end(),
                                                [](const auto& t) { return t.has_value(); }));
}

/// The frames with the deepest shadows.
std::vector<std::size_t> FramesInFullSun(const Brightness& sunlit, const Brightness& shaded) {
  std::vector<double> depths(sunlit.size(), -INFINITY), known;
  for (std::size_t t = 0; t < depths.size(); ++t) {
    if (!sunlit[t] || !shaded[t]) continue;
    depths[t] = *sunlit[t] - *shaded[t];
    known.push_back(-depths[t]);
  }
  std::vector<std::size_t> frames;
  if (known.empty()) return frames;
  // From the deepest down, so that of few frames the deepest counts.
  const double full = -Quantile(known, 1.0 - kDeepest) - kAsDeep;
  for (std::size_t t = 0; t < depths.size(); ++t) {
    if (depths[t] >= full) frames.push_back(t);
  }
  return frames;
}

/// Median brightness of the reference frames.
double UsualOf(const Brightness& brightness, const std::vector<std::size_t>& reference) {
  std::vector<double> values;
  for (const std::size_t t : reference) {
    if (brightness[t]) values.push_back(*brightness[t]);
  }
  return values.empty() ? 0.0 : Median(values);
}

/// Median share of the sun in the light on probes in the sun, or on the others.
double UsualShare(const std::vector<ProbeFit>& probes, bool in_sun) {
  std::vector<double> values;
  for (const ProbeFit& probe : probes) {
    if (!probe.empty() && probe.IsSunlit() == in_sun) values.push_back(probe.SunShare());
  }
  return values.empty() ? 0.0 : Median(values);
}

}  // namespace

std::optional<SunAndSky> SplitLight(double bright, double dark, double in_sun, double in_shade) {
  const double contrast = in_sun - in_shade;
  if (contrast <= kMinContrast) return std::nullopt;
  SunAndSky split{};
  split.sky = std::max((in_sun * dark - in_shade * bright) / contrast, kLeastLight * dark);
  split.sun =
      std::max(((1 - in_shade) * bright - (1 - in_sun) * dark) / contrast, kLeastLight * split.sky);
  return split;
}

LightStart StartLight(const std::vector<ProbeFit>& probes, std::size_t frame_count,
                      std::vector<std::size_t> reference) {
  const auto brightness = [&](std::size_t min_probes, const auto& counts) {
    return FrameBrightness(probes, frame_count, min_probes, counts);
  };
  const auto total = brightness(1, [](const ProbeFit&) { return true; });
  auto sunlit = brightness(kMinStartProbes, [](const ProbeFit& probe) { return probe.IsSunlit(); });
  auto shaded =
      brightness(kMinStartProbes, [](const ProbeFit& probe) { return !probe.IsSunlit(); });
  if (Shown(sunlit) == 0) sunlit = total;
  // Where most frames show too little shade, the brightest ones have the full sun.
  const bool compare = 2 * Shown(shaded) > frame_count;
  std::vector<std::size_t> readings(frame_count, 0);
  for (const ProbeFit& probe : probes) {
    for (const ProbeReading& reading : probe.readings()) ++readings[reading.frame];
  }
  const auto erase_sparse = [&] {
    std::erase_if(reference, [&](std::size_t t) { return readings[t] < kMinStartProbes; });
  };
  erase_sparse();
  if (reference.empty()) {
    reference = FramesInFullSun(sunlit, compare ? shaded : Brightness(frame_count, 0.0));
  }
  if (reference.empty()) {
    for (std::size_t t = 0; t < frame_count; ++t) reference.push_back(t);
  }
  erase_sparse();

  const double all = UsualOf(total, reference), lit = UsualOf(sunlit, reference),
               unlit = UsualOf(shaded, reference);
  const double in_sun = UsualShare(probes, true), in_shade = UsualShare(probes, false);
  LightStart start{std::move(reference), std::vector<LogLight>(frame_count)};
  double ratio = 1.0;  // Of sun and sky. Frames that do not show both kinds have that of the last.
  for (std::size_t t = 0; t < frame_count; ++t) {
    const double whole = total[t] ? std::exp(*total[t] - all) : 1.0;
    double sky = whole / (in_sun * ratio + 1 - in_sun), sun = ratio * sky;
    if (compare && sunlit[t] && shaded[t]) {
      const auto split =
          SplitLight(std::exp(*sunlit[t] - lit), std::exp(*shaded[t] - unlit), in_sun, in_shade);
      if (split) {
        sky = split->sky;
        sun = split->sun;
        ratio = sun / sky;
      }
    }
    start.light[t].head<3>().setConstant(std::log(sun));
    start.light[t].tail<3>().setConstant(std::log(sky));
  }
  return start;
}

}  // namespace pleinair::compositor
