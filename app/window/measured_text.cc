#include "app/window/measured_text.h"

#include <fmt/format.h>

namespace pleinair::app {

std::string MeasuredSunText(const MeasuredLight& drawn, const MeasuredLight& measured) {
  using Source = MeasuredLight::Source;
  const bool by_edges = measured.sun_source == Source::kMeasured;
  if (!by_edges && measured.sun_source != Source::kShade) return "";
  if (!drawn.sun_shines) return "measured: no sun";
  return fmt::format(
      "measured: sun {:.1f} ± {:.1f} times the sky (from {})", drawn.sun_to_sky,
      drawn.sun_to_sky * measured.sun_to_sky_error.value_or(0.0),
      by_edges ? fmt::format("{} edges", measured.edges_agreeing) : "the shade of trees");
}

std::string MeasuredHeadingText(const MeasuredLight& measured) {
  if (measured.heading_source != MeasuredLight::Source::kMeasured) return "";
  return fmt::format("measured: {:+.2f}° ± {:.2f}° from the stated one",
                     ToDegrees(measured.heading_offset),
                     ToDegrees(measured.heading_error.value_or(Radians())));
}

}  // namespace pleinair::app
