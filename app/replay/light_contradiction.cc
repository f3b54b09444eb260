#include "app/replay/light_contradiction.h"

#include <fmt/format.h>

namespace pleinair::app {
namespace {

// Sun-to-sky ratio on level ground below which the sun is not noticeable.
constexpr double kNoticeableSun = 0.1;

}  // namespace

LightContradiction ContradictionOf(const compositor::MeasuredLight& light) {
  using Source = compositor::MeasuredLight::Source;
  if (light.sun_doubtful) {
    return light.evidence.sun_elsewhere ? LightContradiction::kSunElsewhere
                                        : LightContradiction::kShadowsElsewhere;
  }
  const bool has_described_sun = light.sun_to_sky_stated > kNoticeableSun;
  if (light.sun_source == Source::kMarker && !has_described_sun) {
    return LightContradiction::kMarkerDivided;
  }
  if (light.sun_source != Source::kMeasured) return LightContradiction::kNone;
  if (light.sun_shines) {
    return has_described_sun ? LightContradiction::kNone : LightContradiction::kShadowsVisible;
  }
  if (!has_described_sun) return LightContradiction::kNone;
  return light.evidence.edges_agreeing == 0 ? LightContradiction::kNoSunlight
                                            : LightContradiction::kShadowsMissing;
}

std::string SeenText(LightContradiction contradiction, const compositor::MeasuredLight& light) {
  const compositor::LightEvidence& evidence = light.evidence;
  std::string missing =
      fmt::format("no shadow was found where the phantoms would cast one ({} shadow edges checked)",
                  evidence.edges);
  switch (contradiction) {
    case LightContradiction::kNone:
      break;
    case LightContradiction::kNoSunlight:
      return "the brightness of the surfaces shows no sunlight";
    case LightContradiction::kShadowsMissing:
      return missing;
    case LightContradiction::kShadowsVisible:
      return fmt::format("the phantoms' shadows are visible ({} shadow edges)",
                         evidence.edges_agreeing);
    case LightContradiction::kMarkerDivided:
      return "a shadow edge crosses the marker";
    case LightContradiction::kShadowsElsewhere:
      return missing + ", but shadows lie elsewhere";
    case LightContradiction::kSunElsewhere:
      return "the shadows fit a sun elsewhere than the scene's";
  }
  return {};
}

}  // namespace pleinair::app
