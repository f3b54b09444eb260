#include "app/replay/estimate_light.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

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
  if (!state.renderer().DrawsObjects() || state.report.path.empty()) return {};
  const session::FrameLens& lens = state.renderer().lens();
  const session::LightOptions& options = state.options.light;
  const bool wants_focus = options.defocus.mode == session::LensFactMode::kMeasured;
  const bool wants_exposure = options.motion_blur.mode == session::LensFactMode::kMeasured;
  const bool measures_focus =
      lens.MayBeMeasured() && (wants_focus || session::MayTellFocus(*state.pipeline));
  const bool measures_exposure = state.renderer().exposure().MayBeMeasured() &&
                                 (wants_exposure || session::MayTellExposure(*state.pipeline));
  if (!measures_focus && !measures_exposure) return {};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, state.OpenRecording());
  PassBar bar("Measuring the lens", state.report.call.recording);
  PLEINAIR_ASSIGN_OR_RETURN(state.report.film.lens, state.times.Measure("measure lens", [&] {
    return session::MeasureLens(*state.pipeline, lens.Known(), std::move(recording),
                                {bar.Progress(), nullptr});
  }));
  const session::MeasuredLens& measured = *state.report.film.lens;
  std::vector<std::string> warnings;
  if (measures_focus) {
    state.renderer().UseMeasuredLens(measured.fit, state.pipeline->tracks().frame_times());
    warnings = LensWarnings(measured.fit, wants_focus);
  }
  if (measures_exposure) state.renderer().UseMeasuredExposure(measured.exposure);
  if (wants_exposure && !measured.exposure.is_measured()) {
    warnings.push_back(ExposureWarning(measured.exposure));
  }
  std::move(warnings.begin(), warnings.end(), std::back_inserter(state.report.warnings));
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
  if (state.report.path.empty() || !state.scene().DrawsAnything()) return {};
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
