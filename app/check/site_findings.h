#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/check/frame_facts.h"
#include "compositor/photometry/measured_light.h"

namespace pleinair::app {

/// kBad: no right picture is possible. kDoubtful: it may be wrong. kUnknown: could not be checked.
enum class SiteVerdict { kGood, kDoubtful, kBad, kUnknown };

/// One result of a check.
struct SiteFinding {
  std::string subject;  ///< "marker", "size", "blur", …
  SiteVerdict verdict = SiteVerdict::kGood;
  std::string text;
  std::string remedy;  ///< Empty where nothing is to be done.
};

/// "good", "doubtful", "bad", "not checked".
const char* VerdictText(SiteVerdict verdict);

/// Measurements of a site: the input of JudgeSite().
struct SiteFacts {
  std::vector<FrameFacts> frames;  ///< Those that show the marker.
  std::int64_t looked_at = 0;      ///< All frames of the sample.
  std::string marker;              ///< Name of the marker, "sg_17"; empty: none was seen.
  double sun_elevation_deg = 0.0;  ///< At the time of the first frame.
  std::string lens_guess;          ///< Not empty: the lens is assumed, and from what.
  std::optional<compositor::MeasuredLight> light;  ///< Nothing: no objects, or no phantoms.
  bool has_objects = false;
  std::vector<std::string> damage;     ///< What of the recording's frames is lost.
  std::vector<std::string> placement;  ///< PlacementWarnings(), one sentence each.
};

/// Judges: frames, if some are lost, marker, size, view, blur, exposure, lens, sun, heading,
/// object; in this order.
std::vector<SiteFinding> JudgeSite(const SiteFacts& facts);

}  // namespace pleinair::app
