#include "app/replay/draw_day.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/replay/estimate_light.h"
#include "app/replay/time_lapse/time_lapse.h"

namespace pleinair::app {

Result<void> CheckFrameOfDay(const ReplayOptions& options, const devices::FrameSource& frames) {
  if (!options.time_lapse || !options.time_lapse->frame || !frames.CountsExactly()) return {};
  const std::int64_t frame = *options.time_lapse->frame;
  const std::optional<std::int64_t> count = frames.FrameCount();
  if (!count || frame < *count) return {};
  return InputError("--time-lapse-frame",
                    fmt::format("frame {} lies beyond the recording's {}", frame, *count),
                    *count > 0 ? fmt::format("name one of 0 to {}", *count - 1) : "leave it out");
}

Result<session::Observation> ViewOfDay(const ReplayState& state) {
  const std::vector<session::Observation>& path = state.report.path;
  const std::optional<std::int64_t> frame = state.options.time_lapse->frame;
  if (!frame) return path[path.size() / 2];
  for (const session::Observation& at : path) {
    if (at.frame_index == *frame) return at;
  }
  return InputError("--time-lapse-frame", fmt::format("frame {} has no pose", *frame),
                    "name another, or leave it out for the middle one");
}

Result<void> DrawDay(ReplayState& state) {
  if (!state.options.time_lapse) return {};
  ReplayReport& report = state.report;
  if (!state.DrawsDay()) {
    report.warnings.emplace_back(
        "There is no time-lapse: it needs a virtual object and a frame with a pose.");
    return {};
  }
  PLEINAIR_ASSIGN_OR_RETURN(const session::Observation view, ViewOfDay(state));
  session::LightingRequest request =
      state.renderer().MakeLightingRequest(state.scene().place_time.start);
  request.coefficients = TraceCoefficients(state);
  PLEINAIR_ASSIGN_OR_RETURN(
      const auto day,
      DayRenderer::Create(state.pipeline->output_camera(), state.renderer().placed(),
                          std::move(request), state.options.composer));
  PLEINAIR_ASSIGN_OR_RETURN(
      const std::vector<std::string> written, state.times.Measure("draw day", [&] {
        return WriteTimeLapse(*day, state.day_moments, view.camera_from_marker,
                              state.folder.staging(), state.write.frames);
      }));
  report.files.outputs.insert(report.files.outputs.end(), written.begin(), written.end());
  PLEINAIR_ASSIGN_OR_RETURN(report.files.time_lapse, TimeLapseHtml(state.folder.staging()));
  return {};
}

}  // namespace pleinair::app
