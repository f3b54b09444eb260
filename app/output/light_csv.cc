#include "app/output/light_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pleinair::app {
namespace {

LinearRgb Between(LinearRgb a, LinearRgb b, double share) {
  const auto mean = [&](double from, double to) {
    return from > 0.0 && to > 0.0 ? std::exp(std::log(from) * (1 - share) + std::log(to) * share)
                                  : from * (1 - share) + to * share;
  };
  return {mean(a.r, b.r), mean(a.g, b.g), mean(a.b, b.b)};
}

}  // namespace

LightRow LightRowOf(std::int64_t frame_index, std::int64_t timestamp_ns,
                    const session::LightSummary& light) {
  const session::FrameLightSummary& frame = light.frame;
  // The errors of the recording's light and of the change.
  const double error =
      std::hypot(light.measured.sun_to_sky_error.value_or(0.0), frame.followed.log_ratio_error);
  return {frame_index,        timestamp_ns, frame.sun_on_white,
          frame.sky_on_white, error,        frame.followed.source};
}

const char* LightSourceName(compositor::FrameLight::Source source) {
  switch (source) {
    case compositor::FrameLight::Source::kSurfaces:
      return "surfaces";
    case compositor::FrameLight::Source::kColors:
      return "print";
    case compositor::FrameLight::Source::kTotalOnly:
      return "total only";
    case compositor::FrameLight::Source::kStated:
      return "layers";
    case compositor::FrameLight::Source::kHeld:
      return "held";
  }
  return "held";
}

std::vector<LightRow> WithMissingFrames(
    const std::vector<LightRow>& rows,
    const std::vector<std::pair<std::int64_t, std::int64_t>>& frames) {
  if (rows.empty()) return rows;
  std::vector<LightRow> all;
  all.reserve(frames.size());
  auto next = rows.begin();
  for (const auto& [frame_index, timestamp_ns] : frames) {
    while (next != rows.end() && next->frame_index < frame_index) ++next;
    if (next != rows.end() && next->frame_index == frame_index) {
      all.push_back(*next);
      continue;
    }
    const LightRow& after = next == rows.end() ? rows.back() : *next;
    const LightRow& before = next == rows.begin() ? after : *std::prev(next);
    const auto span = static_cast<double>(after.timestamp_ns - before.timestamp_ns);
    const double share =
        span > 0.0
            ? std::clamp(static_cast<double>(timestamp_ns - before.timestamp_ns) / span, 0.0, 1.0)
            : 0.0;
    all.push_back({frame_index, timestamp_ns, Between(before.sun, after.sun, share),
                   Between(before.sky, after.sky, share),
                   std::max(before.sun_to_sky_error, after.sun_to_sky_error),
                   compositor::FrameLight::Source::kHeld});
  }
  return all;
}

std::string LightCsv(const std::vector<LightRow>& rows) {
  std::string csv =
      "frame,timestamp_s,sun_r,sun_g,sun_b,sky_r,sky_g,sky_b,sun_to_sky,sun_to_sky_error,source\n";
  for (const LightRow& row : rows) {
    const double sky = Luminance(row.sky);
    csv += fmt::format("{},{:.6f},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.3g},{}\n",
                       row.frame_index, 1e-9 * static_cast<double>(row.timestamp_ns), row.sun.r,
                       row.sun.g, row.sun.b, row.sky.r, row.sky.g, row.sky.b,
                       sky > 0.0 ? Luminance(row.sun) / sky : 0.0, row.sun_to_sky_error,
                       LightSourceName(row.source));
  }
  return csv;
}

}  // namespace pleinair::app
