#include "app/replay/estimate_light.h"

#include <string>
#include <utility>

#include "app/replay/replay_warnings.h"
#include "app/terminal/pass_bar.h"
#include "app/terminal/progress_bar.h"
#include "session/lens_measurement.h"
#include "session/recording_passes.h"

namespace pleinair::app {

Result<void> EstimateLight(ReplayState& state) {
  if (state.report.path.empty() || !state.renderer().CanMeasureLight()) return {};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, state.OpenRecording());
  PassBar bar("Estimating light", state.report.call.recording);
  return session::EstimateLight(*state.pipeline, std::move(recording),
                                {bar.Progress(), &state.times});
}

Result<void> MeasureLens(ReplayState& state) {
  const session::FrameLens& lens = state.renderer().lens();
  if (!lens.MayBeMeasured() || !state.renderer().DrawsObjects() || state.report.path.empty()) {
    return {};
  }
  const bool is_asked_for = state.options.light.defocus.mode == session::DefocusMode::kMeasured;
  if (!is_asked_for && !session::MayTellFocus(*state.pipeline)) return {};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, state.OpenRecording());
  PassBar bar("Measuring the lens", state.report.call.recording);
  PLEINAIR_ASSIGN_OR_RETURN(state.report.film.lens, state.times.Measure("measure lens", [&] {
    return session::MeasureLens(*state.pipeline, lens.Known(), std::move(recording),
                                {bar.Progress(), nullptr});
  }));
  const compositor::FocusFit& fit = state.report.film.lens->fit;
  state.renderer().UseMeasuredLens(fit, state.pipeline->tracks().frame_times());
  for (std::string& sentence : LensWarnings(fit, is_asked_for)) {
    state.report.warnings.push_back(std::move(sentence));
  }
  return {};
}

std::shared_ptr<const compositor::DaylightCoefficients> TraceCoefficients(ReplayState& state) {
  constexpr int kSteps = 100;
  ProgressBar bar("Tracing light", kSteps, "%");
  int done = 0;
  return state.renderer().Coefficients([&](double share) {
    for (; done < static_cast<int>(share * kSteps); ++done) bar.Advance();
  });
}

Result<void> TraceLight(ReplayState& state) {
  if (state.report.path.empty() || state.scene().objects.empty()) return {};
  if (!state.options.light.cache.empty()) {
    state.times.Measure("trace light", [&] { return TraceCoefficients(state) != nullptr; });
  }
  const ProgressBar bar("Tracing light", 1, "sun");
  return state.times.Measure("light", [&] {
    return state.renderer().PrepareLight(
        state.pipeline->MomentOf(state.report.path.front().timestamp_ns));
  });
}

}  // namespace pleinair::app
