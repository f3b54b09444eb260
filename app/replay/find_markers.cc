#include "app/replay/find_markers.h"

#include <string>
#include <utility>
#include <vector>

#include "app/output/detections_writer.h"
#include "app/output/observed_trajectory.h"
#include "app/output/resumption.h"
#include "app/output/trajectory_export.h"
#include "app/replay/given_trajectory.h"
#include "app/terminal/pass_bar.h"
#include "session/recording_passes.h"

namespace pleinair::app {

Result<void> FindMarkers(ReplayState& state, devices::Recording recording) {
  PLEINAIR_ASSIGN_OR_RETURN(auto detections,
                            DetectionsWriter::Create(state.folder.staging() / "detections.jsonl"));
  const bool keeps_messages =
      state.options.write.exports.contains(exports::TrajectoryFormat::kMcap);
  bool is_first = true;
  const auto take = [&](const devices::Frame& frame,
                        const session::TrackedFrame& tracked) -> Result<void> {
    state.frame_warnings.Add(frame.index, tracked.warnings);
    if (is_first) {
      state.read.first_stamp_ns = frame.timestamp_ns;
      state.report.film.first_frame = frame.index;
      state.report.film.clock_start_ns = ClockStartOf(frame);
    }
    is_first = false;
    state.read.lost_frames += frame.lost_before;
    std::string line =
        DetectionsWriter::Line(frame.index, frame.timestamp_ns, tracked.observations, tracked.lost);
    PLEINAIR_RETURN_IF_ERROR(detections.Add(line));
    if (keeps_messages) state.messages.push_back({frame.timestamp_ns, std::move(line)});
    return {};
  };
  PassBar bar("Finding markers", state.report.call.recording);
  PLEINAIR_RETURN_IF_ERROR(session::TrackRecording(*state.pipeline, std::move(recording), take,
                                                   {bar.Progress(), &state.times}));
  PLEINAIR_RETURN_IF_ERROR(detections.Finish());
  if (state.write.is_resumable) {
    PLEINAIR_RETURN_IF_ERROR(DropFramesOfOtherDetections(state.folder.staging()));
  }
  state.report.files.outputs.emplace_back("detections.jsonl");
  state.report.film.frames = state.pipeline->tracks().frames();
  return {};
}

Result<void> WriteTrajectories(ReplayState& state) {
  const session::MarkerTracks& tracks = state.pipeline->tracks();
  ReplayReport& report = state.report;
  const auto keep = [&](std::vector<std::string> written) {
    report.files.outputs.insert(report.files.outputs.end(), written.begin(), written.end());
  };
  report.reference_marker = tracks.ReferenceMarker();
  report.path = state.pipeline->Path();
  report.placing = {state.pipeline->anchor_summary(), state.pipeline->trajectory_summary()};
  if (const auto marker = state.pipeline->PathMarker()) state.pipeline->MeterLightOn(*marker);
  PLEINAIR_RETURN_IF_ERROR(state.folder.MakeFolder("poses"));
  for (const auto& [marker, observed] : tracks.tracks()) {
    report.markers.push_back(marker);
    PLEINAIR_ASSIGN_OR_RETURN(
        std::vector<std::string> written,
        WriteMarkerTrajectory(marker, ObservedTrajectory(observed), state.options.write.exports,
                              state.folder.staging()));
    keep(std::move(written));
  }
  if (report.placing.trajectory) {
    PLEINAIR_ASSIGN_OR_RETURN(std::vector<std::string> written,
                              WriteGivenTrajectory(report.path, state.folder.staging()));
    keep(std::move(written));
  }
  exports::CameraTrajectory path = ObservedTrajectory(report.path);
  path.camera = state.pipeline->output_camera();
  PLEINAIR_ASSIGN_OR_RETURN(
      std::vector<std::string> exported,
      ExportTrajectory({std::move(path), state.scene(), std::exchange(state.messages, {})},
                       state.options.write.exports, state.folder.staging()));
  keep(std::move(exported));
  return {};
}

}  // namespace pleinair::app
