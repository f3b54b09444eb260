#include "app/lens/lens_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>

#include "export/plots/line_plot.h"

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> kSides = {"top", "left", "bottom", "right"};

Json IfKnown(bool is_known, double value) { return is_known ? Json(value) : Json(); }

/// Milliseconds: null, one number, or one a frame.
Json ExposuresJson(const std::vector<double>& exposures_s) {
  Json exposures;
  for (const double exposure_s : exposures_s) exposures.push_back(1e3 * exposure_s);
  return exposures.size() == 1 ? exposures.front() : exposures;
}

Json MetadataJson(const std::optional<scene::LensDescription>& metadata) {
  if (!metadata) return {};
  Json dioptres, metres;
  if (metadata->focus_dioptres.size() == 1) {
    const double focus = metadata->focus_dioptres.front();
    dioptres = focus;
    metres = IfKnown(focus > 0.0, 1.0 / focus);
  } else if (!metadata->focus_dioptres.empty()) {
    dioptres = metadata->focus_dioptres;
    for (const double focus : metadata->focus_dioptres) {
      metres.push_back(IfKnown(focus > 0.0, 1.0 / focus));
    }
  }
  return {{"focus_m", metres},
          {"focus_dioptres", dioptres},
          {"aperture_mm",
           IfKnown(metadata->aperture_m.has_value(), 1e3 * metadata->aperture_m.value_or(0.0))},
          {"exposure_ms", ExposuresJson(metadata->exposure_s)}};
}

std::string FocusText(double dioptres) {
  return dioptres > 0.0 ? fmt::format("{:.3g} m", 1.0 / dioptres) : std::string("infinity");
}

std::string MetadataText(const std::optional<scene::LensDescription>& metadata) {
  if (!metadata) return "metadata: none\n";
  std::string focus = "unknown";
  if (!metadata->focus_dioptres.empty()) {
    const auto [far, near] = std::ranges::minmax(metadata->focus_dioptres);
    focus = FocusText(near);
    if (near > far) focus += " to " + FocusText(far);
  }
  std::string exposure = "unknown";
  if (!metadata->exposure_s.empty()) {
    const auto [shortest, longest] = std::ranges::minmax(metadata->exposure_s);
    exposure = fmt::format("{:.3g} ms", 1e3 * shortest);
    if (longest > shortest) exposure += fmt::format(" to {:.3g} ms", 1e3 * longest);
  }
  return fmt::format(
      "metadata: focus {}, aperture {}, exposure {}\n", focus,
      metadata->aperture_m ? fmt::format("{:.3g} mm", 1e3 * *metadata->aperture_m) : "unknown",
      exposure);
}

std::string ExposureText(const compositor::ExposureFit& fit) {
  if (fit.is_measured()) {
    return fmt::format("exposure: {:.3g} ms ± {:.2g} ms, streaks of up to {:.1f} px\n",
                       1e3 * fit.exposure_s, 1e3 * fit.error_s, fit.longest_streak_px);
  }
  std::string text = "exposure not measured: " + fit.reason;
  if (fit.shorter_than_s > 0.0) {
    text += fmt::format(": it is below {:.2g} ms", 1e3 * fit.shorter_than_s);
  }
  return text + "\n";
}

}  // namespace

std::string LensJsonText(const session::MeasuredLens& measured,
                         const std::optional<scene::LensDescription>& metadata) {
  const compositor::FocusFit& fit = measured.fit;
  const bool known = fit.is_measured(), exposed = measured.exposure.is_measured();
  const Json json{{"measured", known},
                  {"reason", known ? Json() : Json(fit.reason)},
                  {"focus_m", IfKnown(known && fit.focus_dioptres > 0.0, 1.0 / fit.focus_dioptres)},
                  {"focus_dioptres", IfKnown(known, fit.focus_dioptres)},
                  {"focus_dioptres_error", IfKnown(known, fit.focus_dioptres_error)},
                  {"aperture_mm", IfKnown(known, 1e3 * fit.aperture_m)},
                  {"aperture_relative_error", IfKnown(known, fit.aperture_relative_error)},
                  {"in_focus_blur_px", IfKnown(known, fit.in_focus_blur_px)},
                  {"exposure_ms", IfKnown(exposed, 1e3 * measured.exposure.exposure_s)},
                  {"exposure_error_ms", IfKnown(exposed, 1e3 * measured.exposure.error_s)},
                  {"exposure_reason", exposed ? Json() : Json(measured.exposure.reason)},
                  {"readings", fit.readings},
                  {"nearest_m", IfKnown(fit.nearest_m > 0.0, fit.nearest_m)},
                  {"farthest_m", IfKnown(fit.farthest_m > 0.0, fit.farthest_m)},
                  {"metadata", MetadataJson(metadata)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string LensText(const session::MeasuredLens& measured,
                     const std::optional<scene::LensDescription>& metadata) {
  const compositor::FocusFit& fit = measured.fit;
  std::string text;
  if (fit.is_measured()) {
    text = fmt::format(
        "focus: {} ({:.3f} ± {:.3f} /m)\naperture: {:.3g} mm ± {:.1f} %\n"
        "in-focus blur: {:.2f} px\n",
        FocusText(fit.focus_dioptres), fit.focus_dioptres, fit.focus_dioptres_error,
        1e3 * fit.aperture_m, 100.0 * fit.aperture_relative_error, fit.in_focus_blur_px);
    for (const compositor::FocusAt& at : fit.changes) {
      text += fmt::format("    at {:.1f} s: {} ({:.3f} ± {:.3f} /m)\n", at.timestamp_s,
                          FocusText(at.focus_dioptres), at.focus_dioptres, at.error);
    }
  } else {
    text = "not measured: " + fit.reason +
           "\n    film the marker while you walk from near it to at least twice that distance\n";
  }
  if (fit.nearest_m > 0.0) {
    text += fmt::format("readings: {}, marker from {:.2f} to {:.2f} m\n", fit.readings,
                        fit.nearest_m, fit.farthest_m);
  }
  return text + ExposureText(measured.exposure) + MetadataText(metadata);
}

std::string ReadingsCsv(const std::vector<compositor::BlurReading>& readings) {
  std::string csv = "frame,timestamp_s,side,distance_m,blur_px\n";
  for (const compositor::BlurReading& reading : readings) {
    csv += fmt::format("{},{:.6f},{},{:.5f},{:.4f}\n", reading.frame_index, reading.timestamp_s,
                       kSides.at(static_cast<std::size_t>(reading.side)), 1.0 / reading.dioptres,
                       reading.blur_px);
  }
  return csv;
}

std::string ReadingsPlot(const session::MeasuredLens& measured) {
  if (measured.readings.empty()) return "";
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN(), kLeast_px = 0.01;
  exports::PlotLine fitted{"fitted", {}, {}}, read{"read on the marker's sides", {}, {}};
  double nearest = 0.0, farthest = std::numeric_limits<double>::infinity();
  read.x.reserve(3 * measured.readings.size());
  read.y.reserve(3 * measured.readings.size());
  for (const compositor::BlurReading& reading : measured.readings) {
    const double half = std::max(kLeast_px, reading.error_px);
    for (const double y : {reading.blur_px - half, reading.blur_px + half, kGap}) {
      read.x.push_back(reading.dioptres);
      read.y.push_back(y);
    }
    nearest = std::max(nearest, reading.dioptres);
    farthest = std::min(farthest, reading.dioptres);
  }
  const compositor::FocusFit& fit = measured.fit;
  constexpr int kPoints = 64;
  fitted.x.reserve(kPoints + 1);
  fitted.y.reserve(kPoints + 1);
  for (int i = 0; fit.is_measured() && i <= kPoints; ++i) {
    const double q = farthest + (nearest - farthest) * i / kPoints;
    fitted.x.push_back(q);
    fitted.y.push_back(std::hypot(fit.in_focus_blur_px,
                                  0.25 * measured.fx * fit.aperture_m * (q - fit.focus_dioptres)));
  }
  return exports::LinePlotSvg("Blur over the reciprocal distance", "px", {fitted, read}, "/m");
}

}  // namespace pleinair::app
