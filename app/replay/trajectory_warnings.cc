#include "app/replay/trajectory_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "base/units.h"

namespace pleinair::app {
namespace {

/// Chi-square over its degrees of freedom above which the corners' noise does not explain the
/// residuals: three standard deviations.
constexpr double kExplainedChi2 = 9.0;
/// Levelled phones keep the vertical within a degree; the marker may lie on sloping ground.
constexpr double kNoticeableTilt_deg = 15.0;

std::string Rests(const session::TrajectorySummary& summary) {
  const session::TrajectoryAlignment& alignment = summary.alignment;
  const std::string by = summary.by_points ? fmt::format("{} places", alignment.used)
                                           : fmt::format("the marker in {} frames",
                                                         alignment.used - alignment.outliers);
  return fmt::format(
      "{} frames have their pose from the trajectory {}, {} of them without marker. It is aligned "
      "by {}, which leaves the marker's centre uncertain by {:.1f} mm; errors of the trajectory "
      "itself come on top.",
      summary.frames.by_trajectory, summary.file, summary.frames.without_marker, by,
      1e3 * summary.centre_deviation_m);
}

std::string OffsetSentence(const session::TrajectoryOffset& offset) {
  const double seconds = 1e-9 * static_cast<double>(offset.offset_ns);
  const std::string offset_text = fmt::format(
      "The offset between the clocks of recording and trajectory is {:.4f} s, ", seconds);
  if (offset.is_given) return offset_text + "as given.";
  if (!offset.deviation_s) {
    return offset_text +
           "assumed: too few frames show the marker to estimate it. --trajectory-offset-s states "
           "it.";
  }
  return fmt::format(
      "The offset between the clocks of recording and trajectory was estimated: {:.4f} ± {:.4f} s. "
      "--trajectory-offset-s states it.",
      seconds, *offset.deviation_s);
}

}  // namespace

std::string ClockText(const session::TrajectorySummary& summary) {
  if (summary.by_frame) return "";
  const std::string from =
      summary.offset.deviation_s
          ? fmt::format("estimated within {:.3f} s", *summary.offset.deviation_s)
          : std::string(summary.offset.is_given ? "given" : "assumed");
  return fmt::format("offset of its clock {:.3f} s, {}",
                     1e-9 * static_cast<double>(summary.offset.offset_ns), from);
}

bool HasAssumedOffset(const session::TrajectorySummary& summary) {
  return !summary.by_frame && !summary.offset.is_given && !summary.offset.deviation_s;
}

bool DisagreesWithMarker(const session::TrajectorySummary& summary) {
  return !summary.by_points && summary.alignment.chi2_per_dof > kExplainedChi2;
}

bool HasTiltedMarker(const session::TrajectorySummary& summary) {
  return summary.tilt && ToDegrees(*summary.tilt) > kNoticeableTilt_deg;
}

std::vector<std::string> TrajectoryWarnings(const session::TrajectorySummary& summary) {
  const session::TrajectoryAlignment& alignment = summary.alignment;
  std::vector<std::string> warnings{Rests(summary)};
  if (!summary.by_frame) warnings.push_back(OffsetSentence(summary.offset));
  if (DisagreesWithMarker(summary)) {
    warnings.push_back(fmt::format(
        "Trajectory and marker disagree by {:.1f} px (at most {:.1f} px), more than the corners' "
        "noise explains. The object moves so far against the marker. Check the lens, the "
        "trajectory's drift, its offset and --trajectory-turn-deg.",
        alignment.residual_rms, alignment.residual_max));
  }
  if (summary.by_points) {
    warnings.push_back(fmt::format(
        "The places that align the trajectory are off by {:.1f} mm (at most {:.1f} mm).",
        1e3 * alignment.residual_rms, 1e3 * alignment.residual_max));
    if (summary.marker_rms_px) {
      warnings.push_back(
          fmt::format("By these places, the marker's corners are {:.1f} px from where frames show "
                      "them.",
                      *summary.marker_rms_px));
    }
  }
  if (alignment.outliers > 0) {
    warnings.push_back(fmt::format(
        "{} of {} frames with the marker contradict the others and do not count for the alignment.",
        alignment.outliers, alignment.used));
  }
  if (HasTiltedMarker(summary)) {
    warnings.push_back(fmt::format(
        "By the trajectory, the marker is tilted by {:.0f} degrees. If it is not, the frames are "
        "turned against the trajectory's images (--trajectory-turn-deg), or the scene's upright is "
        "wrong.",
        ToDegrees(*summary.tilt)));
  }
  if (summary.frames.by_marker > 0) {
    warnings.push_back(
        fmt::format("{} frames outside the trajectory have their pose from the marker: the object "
                    "may jump there.",
                    summary.frames.by_marker));
  }
  if (summary.frames.filled > 0) {
    warnings.push_back(fmt::format(
        "{} frames in gaps of the trajectory have their pose from the camera's motion before and "
        "after.",
        summary.frames.filled));
  }
  if (summary.frames.missing > 0) {
    warnings.push_back(fmt::format(
        "{} frames have no pose in the trajectory: they are left as they were recorded.",
        summary.frames.missing));
  }
  return warnings;
}

}  // namespace pleinair::app
