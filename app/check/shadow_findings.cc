#include "app/check/shadow_findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/replay/light_contradiction.h"
#include "base/units.h"
#include "compositor/photometry/sun_sky_ratio.h"

namespace pleinair::app {
namespace {

using Verdict = SiteVerdict;
using Source = compositor::MeasuredLight::Source;

// Compasses of phones are off by so much; replay corrects it.
constexpr double kDoubtful_deg = 5.0;
// Trees and houses beside the scene hide edges where they shade so much.
constexpr double kNoticeableShade = 0.05;

constexpr const char* kCompare = "compare the object's shadow in first.png with a real one";

/// "2025-09-14T11:05Z", the nearest minute.
std::string MinuteOf(UtcTime time) {
  constexpr double kHalfMinute_s = 30.0;
  constexpr std::size_t kMinutes = 16;
  return time.PlusSeconds(kHalfMinute_s).ToString().substr(0, kMinutes) + "Z";
}

std::string RemedyForSunElsewhere(const SiteFacts& facts) {
  const compositor::SunElsewhere& elsewhere = *facts.light->evidence.sun_elsewhere;
  std::vector<std::string> fits;
  if (facts.shadows.time_that_fits) {
    fits.push_back(
        fmt::format("the time {} at this heading", MinuteOf(*facts.shadows.time_that_fits)));
  }
  if (elsewhere.heading_offset) {
    const double offset_deg = ToDegrees(*elsewhere.heading_offset);
    fits.push_back(fmt::format("a heading {:.0f} degrees {} at this time", std::abs(offset_deg),
                               offset_deg > 0.0 ? "larger" : "smaller"));
  }
  if (!elsewhere.time_fits_better) std::reverse(fits.begin(), fits.end());
  return fmt::format("time or heading is wrong: check the offset from UTC and the compass; {} fits",
                     fmt::join(fits, " fits best, "));
}

/// A heading that no shadow gave.
SiteFinding UnmeasuredHeading(const SiteFacts& facts) {
  const compositor::MeasuredLight& light = *facts.light;
  const compositor::LightEvidence& evidence = light.evidence;
  if (facts.shadows.casters == 0) {
    return {"heading", Verdict::kUnknown, "nothing is described that casts a shadow",
            "describe what does, [[box]] or [[wall]] (docs/guide/reference/scenes.md), or " +
                std::string(kCompare)};
  }
  if (evidence.edges == 0) {
    return {"heading", Verdict::kUnknown,
            "no edge of a described surface's shadow is in view on described ground",
            "film from where one is seen, describe the ground it falls on, or " +
                std::string(kCompare)};
  }
  if (evidence.edges < compositor::kMinEdgesForNoSun) {
    return {"heading", Verdict::kUnknown,
            fmt::format("the shadows of described surfaces are short or hidden: {} places of their "
                        "edges are in view, and {} are needed",
                        evidence.edges, compositor::kMinEdgesForNoSun),
            "film more of their shadows, describe something taller, or " + std::string(kCompare)};
  }
  if (light.sun_source == Source::kShade || light.shaded > kNoticeableShade) {
    return {"heading", Verdict::kUnknown, "shade of what is not described hides the shadows' edges",
            "describe what casts it, or " + std::string(kCompare)};
  }
  if (light.sun_source != Source::kMeasured &&
      evidence.edges_with_contrast < compositor::kSunShare) {
    return {"heading", Verdict::kDoubtful,
            fmt::format("{} places of shadow edges are expected in view, and few of them show one",
                        evidence.edges),
            "check time, heading, and the place and size of boxes and walls; without sun, write "
            "cloudiness = \"overcast\""};
  }
  return {"heading", Verdict::kUnknown,
          fmt::format("{} of {} places of shadow edges agree, too few to measure it",
                      evidence.edges_agreeing, evidence.edges),
          "film more of the shadows, or " + std::string(kCompare)};
}

}  // namespace

SiteFinding HeadingFinding(const SiteFacts& facts) {
  if (!facts.light || facts.frames.empty()) {
    return {"heading", Verdict::kUnknown,
            facts.has_objects ? "without ground or walls no shadow is known"
                              : "the scene has no object",
            "describe what casts a shadow: [[box]], [[wall]] (docs/guide/reference/scenes.md)"};
  }
  const compositor::MeasuredLight& light = *facts.light;
  const LightContradiction contradiction = ContradictionOf(light);
  switch (contradiction) {
    case LightContradiction::kSunElsewhere:
      return {"heading", Verdict::kDoubtful, SeenText(contradiction, light),
              RemedyForSunElsewhere(facts)};
    case LightContradiction::kShadowsElsewhere:
      return {"heading", Verdict::kDoubtful, SeenText(contradiction, light),
              "check time and its offset from UTC, heading, and the place of boxes and walls"};
    case LightContradiction::kShadowsMissing:
    case LightContradiction::kNoSunlight:
      return {"heading", Verdict::kUnknown, "the frames show no sun",
              "if the sun shone, check time, heading, and the place of boxes and walls"};
    case LightContradiction::kNone:
    case LightContradiction::kShadowsVisible:
    case LightContradiction::kMarkerDivided:
      break;
  }
  if (light.sun_source == Source::kMeasured && !light.sun_shines) {
    return {"heading", Verdict::kUnknown, "without sunlight no shadow shows it", ""};
  }
  if (light.heading_source != Source::kMeasured) return UnmeasuredHeading(facts);
  const double offset_deg = ToDegrees(light.heading_offset);
  SiteFinding finding{
      "heading", Verdict::kGood,
      fmt::format("shadows turn it by {:+.1f} degrees, which replay does", offset_deg), ""};
  if (std::abs(offset_deg) <= kDoubtful_deg) return finding;
  finding.verdict = Verdict::kDoubtful;
  finding.remedy = "check time and compass; then write the corrected heading into the scene";
  return finding;
}

SiteFinding SkyFinding(const SiteFacts& facts) {
  if (!facts.light || facts.frames.empty()) {
    return {"sky", Verdict::kUnknown, "without described surfaces no sun or shade is known", ""};
  }
  const compositor::MeasuredLight& light = *facts.light;
  const LightContradiction contradiction = ContradictionOf(light);
  switch (contradiction) {
    case LightContradiction::kShadowsVisible:
    case LightContradiction::kMarkerDivided:
      return {"sky", Verdict::kDoubtful,
              SeenText(contradiction, light) + ", but the scene describes an overcast sky",
              "replay assumes that the sun shines; correct cloudiness in the scene"};
    case LightContradiction::kShadowsMissing:
    case LightContradiction::kNoSunlight:
      return {"sky", Verdict::kDoubtful,
              SeenText(contradiction, light) + ", but the scene describes a sky with a sun",
              "replay assumes an overcast sky; write cloudiness = \"overcast\", or check time and "
              "heading"};
    case LightContradiction::kShadowsElsewhere:
    case LightContradiction::kSunElsewhere:
      return {"sky", Verdict::kUnknown, "shadows lie elsewhere than the scene would cast them",
              "correct time and heading first"};
    case LightContradiction::kNone:
      break;
  }
  if (light.sun_source == Source::kDescription || light.sun_source == Source::kOverride) {
    return {"sky", Verdict::kUnknown, "the frames do not show whether the sun shone", ""};
  }
  if (!light.sun_shines) {
    return {"sky", Verdict::kGood, "the frames show no sunlight, as the scene describes", ""};
  }
  return {"sky", Verdict::kGood, "the frames show sunlight, as the scene describes", ""};
}

}  // namespace pleinair::app
