#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/check/frame_facts.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "compositor/photometry/measured_light.h"
#include "session/trajectory/follow_trajectory.h"

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

/// How the scene's trajectory fits the film.
struct TrajectoryFit {
  bool has_marker = true;  ///< It is aligned by places, or a frame shows the marker.
  Result<session::TrajectorySummary> summary{};  ///< Error: it does not fit, and why.
};

/// What is known of a site's shadows beside the light estimate.
struct ShadowFacts {
  int casters = 0;  ///< Described surfaces that can cast a shadow: all but level ground.
  /// Time at which the sun stands where the shadows fit, if they fit one elsewhere.
  std::optional<UtcTime> time_that_fits{};
};

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
  std::int64_t with_pose = 0;  ///< Frames with a pose, by the marker, anchors or a trajectory.
  std::optional<TrajectoryFit> trajectory{};  ///< Nothing: the scene has none.
  ShadowFacts shadows{};
};

/// Judges: frames, if some are lost, marker, trajectory, if there is one, size, view, blur,
/// exposure, lens, sun, heading, sky, object; in this order.
std::vector<SiteFinding> JudgeSite(const SiteFacts& facts);

}  // namespace pleinair::app
