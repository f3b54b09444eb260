#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/changes/light_probes.h"

namespace pleinair::compositor {

/// Sun and sky of one frame, relative to the light that was estimated for the recording.
struct FrameLight {
  /// What told sun and sky apart: surfaces in sun and shade; the colors of surfaces in one light;
  /// nothing, so that both follow the total brightness; no surface at all, so that the light is
  /// interpolated in time; or the description alone.
  enum class Source { kSurfaces, kColors, kTotalOnly, kHeld, kStated };
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;  ///< Since the recording's start.
  /// Factors on the display-linear light of sun and sky, exposure and white balance included.
  LinearRgb sun{1.0, 1.0, 1.0}, sky{1.0, 1.0, 1.0};
  /// Standard deviation of the logarithm of sun over sky, mean of the channels.
  double log_ratio_error = 0.0;
  Source source = Source::kHeld;

  /// Mean logarithm of sun over sky.
  double LogRatio() const { return MeanLog(sun) - MeanLog(sky); }
};

/// Light of a recording, frame by frame.
struct LightChanges {
  std::vector<FrameLight> frames;  ///< In the order of the probed frames.
  /// True if sun over sky changes, and a steady light explains the readings much worse. Otherwise
  /// that steady light is given here, of which only the exposure changes.
  bool changes = false;
};

/// Estimates sun and sky in each frame, as a maximum a posteriori fit.
///
/// Model, for probe i, frame t and channel c, with the light `light` of the reference frames:
///
///     linear_itc = ρ_ic (a_tc e^{κ_ic} (V_i direct_ic + reflected_ic) + b_tc sky_ic)
///
/// The albedo ρ is constant in time; V is the phantoms' sun visibility, or 0 where unmodelled
/// geometry shades the probe, whichever explains the probe over time. κ is the error of the
/// modelled sun over sky: one of all probes with the same normal, plus the probe's own. Residuals
/// are relative and have Student's distribution. The logarithms of a and b follow random walks with
/// heavy-tailed steps, and channels change nearly alike. `reference` are indices of frames in which
/// the mean logarithm of a, and that of b, is 0: ρ alone would leave their scale open. Without any,
/// these are the frames in which shadows are deepest: those in full sun. Frames with fewer than 5
/// readings are no reference.
///
/// The model is ours; the steps of the walk follow Lange, Little & Taylor 1989 (light_walk.h).
LightChanges FitLightChanges(const std::vector<ProbedFrame>& frames,
                             const std::vector<LightProbe>& probes,
                             const std::vector<ProbeLight>& light,
                             const std::vector<std::size_t>& reference);

}  // namespace pleinair::compositor
