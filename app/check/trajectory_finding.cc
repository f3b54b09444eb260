#include "app/check/trajectory_finding.h"

#include <fmt/format.h>

#include "app/replay/trajectory_warnings.h"
#include "base/units.h"

namespace pleinair::app {
namespace {

std::string AlignmentText(const session::TrajectorySummary& summary) {
  const session::TrajectoryAlignment& alignment = summary.alignment;
  return summary.by_points
             ? fmt::format("aligned by {} places within {:.0f} mm", alignment.used,
                           1e3 * alignment.residual_rms)
             : fmt::format("aligned by the marker in {} frames within {:.1f} pixels",
                           alignment.used - alignment.outliers, alignment.residual_rms);
}

}  // namespace

SiteFinding TrajectoryFinding(const TrajectoryFit& fit, std::int64_t looked_at) {
  if (!fit.has_marker) {
    return {"trajectory", SiteVerdict::kUnknown, "no frame of the sample shows the marker",
            "show the marker for longer, or give three places as points of [trajectory]"};
  }
  if (!fit.summary) {
    return {"trajectory", SiteVerdict::kBad, fit.summary.error().what, fit.summary.error().remedy};
  }
  const session::TrajectorySummary& summary = *fit.summary;
  const std::int64_t covered = summary.frames.by_trajectory;
  const std::string clock = ClockText(summary);
  SiteFinding finding{"trajectory", SiteVerdict::kGood,
                      fmt::format("it has the pose of {} of {} frames, {}{}{}", covered, looked_at,
                                  AlignmentText(summary), clock.empty() ? "" : "; ", clock),
                      ""};
  if (DisagreesWithMarker(summary)) {
    finding.verdict = SiteVerdict::kDoubtful;
    finding.text = fmt::format("trajectory and marker disagree by {:.1f} pixels, at most {:.1f}",
                               summary.alignment.residual_rms, summary.alignment.residual_max);
    finding.remedy = "check the lens, offset_s, turn_deg and scale, and the trajectory's drift";
  } else if (HasTiltedMarker(summary)) {
    finding.verdict = SiteVerdict::kDoubtful;
    finding.text = fmt::format("by the trajectory, the marker is tilted by {:.0f} degrees",
                               ToDegrees(*summary.tilt));
    finding.remedy = "check turn_deg of [trajectory], and upright of the marker";
  } else if (10 * covered < 9 * looked_at) {
    finding.verdict = SiteVerdict::kDoubtful;
    finding.remedy = "check offset_s, max_gap_s, and that it belongs to this film";
  } else if (HasAssumedOffset(summary)) {
    finding.verdict = SiteVerdict::kDoubtful;
    finding.remedy =
        "state offset_s, or show an S-G marker or AprilTag for a second while the camera moves";
  }
  return finding;
}

}  // namespace pleinair::app
