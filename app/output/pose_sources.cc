#include "app/output/pose_sources.h"

#include <fmt/format.h>

#include "export/trajectories/text_lines.h"

namespace pleinair::app {
namespace {

const char* PoseSourceName(session::PoseSource source) {
  switch (source) {
    case session::PoseSource::kMarker:
      return "marker";
    case session::PoseSource::kAnchors:
      return "anchors";
    case session::PoseSource::kMotion:
      return "motion";
    case session::PoseSource::kTrajectory:
      break;
  }
  return "trajectory";
}

}  // namespace

std::string PoseSourcesCsv(const std::vector<session::Observation>& path) {
  std::string text = "frame,timestamp_s,source,marker_seen,centre_deviation_m\n";
  for (const session::Observation& at : path) {
    text += fmt::format("{},{},{},{},", at.frame_index, exports::SecondsText(at.timestamp_ns),
                        PoseSourceName(at.source), session::ShowsReferenceMarker(at) ? 1 : 0);
    if (at.source == session::PoseSource::kTrajectory) {
      text += fmt::format("{:.6f}", at.centre_deviation_m);
    }
    text += '\n';
  }
  return text;
}

}  // namespace pleinair::app
