#include "app/replay/estimate_light.h"

#include <utility>

#include "app/terminal/pass_bar.h"
#include "app/terminal/progress_bar.h"
#include "session/recording_passes.h"

namespace pleinair::app {

Result<void> EstimateLight(ReplayState& state) {
  if (state.report.path.empty() || !state.renderer().CanMeasureLight()) return {};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, state.OpenRecording());
  PassBar bar("Estimating light", state.report.call.recording);
  return session::EstimateLight(*state.pipeline, std::move(recording),
                                {bar.Progress(), &state.times});
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
