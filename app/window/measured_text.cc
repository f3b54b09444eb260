#include "app/window/measured_text.h"

#include <fmt/format.h>

namespace pleinair::app {

std::string MeasuredSunText(const compositor::MeasuredLight& drawn,
                            const compositor::MeasuredLight& measured) {
  using Source = compositor::MeasuredLight::Source;
  const auto from = [&]() -> std::string {
    switch (measured.sun_source) {
      case Source::kMeasured:
        return fmt::format("{} edges", measured.evidence.edges_agreeing);
      case Source::kShade:
        return "the shadows of trees";
      case Source::kMarker:
        return "a shadow edge on the marker";
      case Source::kDescription:
      case Source::kOverride:
        return "";
    }
    return "";
  }();
  if (from.empty()) return "";
  if (!drawn.sun_shines) return "measured: no sun";
  return fmt::format("measured: sun {:.1f} ± {:.1f} times the sky (from {})", drawn.sun_to_sky,
                     drawn.sun_to_sky * measured.sun_to_sky_error.value_or(0.0), from);
}

std::string MeasuredHeadingText(const compositor::MeasuredLight& measured) {
  if (measured.heading_source != compositor::MeasuredLight::Source::kMeasured) return "";
  return fmt::format("measured: {:+.2f}° ± {:.2f}° from the scene's",
                     ToDegrees(measured.heading_offset),
                     ToDegrees(measured.heading_error.value_or(Radians())));
}

}  // namespace pleinair::app
