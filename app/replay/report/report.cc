#include "app/replay/report/report.h"

#include <algorithm>

#include "base/units.h"
#include "tracker/observation.h"

namespace pleinair::app {
PoseStatistics SummarizeTrajectory(const std::vector<session::Observation>& path) {
  PoseStatistics statistics;
  if (path.empty()) return statistics;
  std::vector<double> distances_m, errors_px, turns_deg, moves_m, visible;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const session::Observation& at = path[i];
    distances_m.push_back(Norm(at.camera_from_marker.translation_m));
    const bool by_trajectory = at.source == session::PoseSource::kTrajectory;
    if (at.source != session::PoseSource::kMotion &&
        (!by_trajectory || session::ShowsReferenceMarker(at))) {
      errors_px.push_back(at.reprojection_rms_px);
      visible.push_back(at.visible_fraction);
      ++statistics.found_by[static_cast<std::size_t>(at.path)];
      if (at.ambiguity_ratio > tracker::kCertainRatio) ++statistics.ambiguous_frames;
    }
    if (i == 0 || at.frame_index != path[i - 1].frame_index + 1) continue;
    const auto here = at.camera_from_marker.Inverse();
    const auto before = path[i - 1].camera_from_marker.Inverse();
    moves_m.push_back(Norm(here.translation_m - before.translation_m));
    turns_deg.push_back(ToDegrees(Radians(session::RotationAngle(before.rotation, here.rotation))));
    statistics.path_length_m += moves_m.back();
  }
  const auto [nearest, farthest] = std::minmax_element(distances_m.begin(), distances_m.end());
  statistics.distance_min_m = *nearest;
  statistics.distance_max_m = *farthest;
  statistics.distance_median_m = StageTimes::Quantile(distances_m, 0.5);
  statistics.step_rotation_p95_deg = StageTimes::Quantile(turns_deg, 0.95);
  statistics.step_translation_p95_m = StageTimes::Quantile(moves_m, 0.95);
  if (visible.empty()) return statistics;
  statistics.visible_min = *std::min_element(visible.begin(), visible.end());
  statistics.visible_median = StageTimes::Quantile(visible, 0.5);
  statistics.reprojection_median_px = StageTimes::Quantile(errors_px, 0.5);
  statistics.reprojection_p95_px = StageTimes::Quantile(errors_px, 0.95);
  return statistics;
}

LostFrames CountLostFrames(const std::vector<session::Observation>& path, std::int64_t end) {
  LostFrames lost;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::int64_t next = i + 1 < path.size() ? path[i + 1].frame_index : end;
    const std::int64_t gap = next - path[i].frame_index - 1;
    lost.frames += gap;
    lost.longest = std::max(lost.longest, gap);
  }
  return lost;
}

const char* CloudinessName(scene::Cloudiness cloudiness) {
  switch (cloudiness) {
    case scene::Cloudiness::kClear:
      return "clear";
    case scene::Cloudiness::kHazy:
      return "hazy";
    case scene::Cloudiness::kPartlyCloudy:
      return "partly cloudy";
    case scene::Cloudiness::kOvercast:
      return "overcast";
  }
  return "clear";
}

}  // namespace pleinair::app
