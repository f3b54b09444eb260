#include "app/replay/draw_day.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/replay/estimate_light.h"
#include "app/replay/time_lapse/time_lapse.h"
#include "compositor/light/light_solver.h"
#include "compositor/photometry/sky_fit.h"
#include "session/leaf_materials.h"
#include "session/scene_light.h"
#include "sky/clouds/cloud_shadow.h"

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

namespace {

/// True if leaves differ from date to date.
bool LeavesChange(const ReplayState& state) {
  return state.day_moments.over_dates &&
         std::ranges::any_of(state.scene().leaves,
                             [](const auto& leaf) { return !leaf.stages.empty(); });
}

/// The light of a time-lapse. Layers of clouds rule it: the sky between them is the described one,
/// because the film's may have been measured under such clouds.
session::LightingRequest RequestOf(const ReplayState& state) {
  session::LightingRequest request =
      state.renderer().MakeLightingRequest(state.scene().place_time.start);
  if (state.scene().clouds.layers.empty()) return request;
  request.skies = {.source = compositor::DescribedSky(state.scene())};
  request.clouds = clouds::MakeFields(state.scene().clouds.layers);
  request.clouds_rule = true;
  return request;
}

/// The scene with the leaves of `time`, whose light is traced for each picture.
Result<std::unique_ptr<DayRenderer>> RendererWithLeavesOf(ReplayState& state, UtcTime time) {
  std::vector<compositor::PlacedModel> placed = state.renderer().placed();
  PLEINAIR_RETURN_IF_ERROR(session::ReplaceByLeaves(state.scene().leaves, time, &placed));
  session::LightingRequest request = RequestOf(state);
  request.coefficients = nullptr;
  PLEINAIR_ASSIGN_OR_RETURN(
      request.solver,
      compositor::LightSolver::Create(placed, session::SolverOptionsOf(state.options.light)));
  return DayRenderer::Create(state.pipeline->output_camera(), std::move(placed), std::move(request),
                             state.options.composer);
}

/// One renderer for all times, by daylight coefficients; where leaves change, one for each time.
Result<RendererAt> RenderersOf(ReplayState& state) {
  auto day = std::make_shared<std::unique_ptr<DayRenderer>>();
  if (LeavesChange(state)) {
    return [&state, day,
            made_for = std::optional<UtcTime>()](UtcTime time) mutable -> Result<DayRenderer*> {
      if (made_for != time) {
        day->reset();
        PLEINAIR_ASSIGN_OR_RETURN(*day, RendererWithLeavesOf(state, time));
        made_for = time;
      }
      return day->get();
    };
  }
  session::LightingRequest request = RequestOf(state);
  request.coefficients = TraceCoefficients(state);
  PLEINAIR_ASSIGN_OR_RETURN(
      *day, DayRenderer::Create(state.pipeline->output_camera(), state.renderer().placed(),
                                std::move(request), state.options.composer));
  return [day](UtcTime) -> Result<DayRenderer*> { return day->get(); };
}

}  // namespace

Result<void> DrawDay(ReplayState& state) {
  if (!state.options.time_lapse) return {};
  ReplayReport& report = state.report;
  if (!state.DrawsDay()) {
    report.warnings.emplace_back(
        "There is no time-lapse: it needs a virtual object and a frame with a pose.");
    return {};
  }
  PLEINAIR_ASSIGN_OR_RETURN(const session::Observation view, ViewOfDay(state));
  PLEINAIR_ASSIGN_OR_RETURN(const RendererAt renderer_at, RenderersOf(state));
  PLEINAIR_ASSIGN_OR_RETURN(
      const std::vector<std::string> written, state.times.Measure("draw day", [&] {
        return WriteTimeLapse(renderer_at, state.day_moments, view.camera_from_marker,
                              state.folder.staging(), state.write.frames);
      }));
  report.files.outputs.insert(report.files.outputs.end(), written.begin(), written.end());
  PLEINAIR_ASSIGN_OR_RETURN(report.files.time_lapse, TimeLapseHtml(state.folder.staging()));
  return {};
}

}  // namespace pleinair::app
