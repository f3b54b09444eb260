#pragma once

#include <vector>

#include "base/error.h"
#include "compositor/lens/exposure_fit.h"
#include "compositor/lens/focus_fit.h"
#include "devices/recordings/recording.h"
#include "session/recording_passes.h"

namespace pleinair::session {

/// What the frames of a recording tell of the lens.
struct MeasuredLens {
  double fx = 0.0;  ///< Focal length of the frames, pixels.
  compositor::FocusFit fit;
  compositor::ExposureFit exposure;
  std::vector<compositor::BlurReading> readings;  ///< One a side of the marker and frame.
};

/// False where the reference marker is missing, or stays at one distance, so that its blur tells no
/// focus. Needs no frame.
bool MayTellFocus(const Pipeline& pipeline);

/// False where the reference marker is missing, or moves so little from frame to frame that its
/// blur tells no exposure. Needs no frame.
bool MayTellExposure(const Pipeline& pipeline);

/// Measures focus, aperture and exposure on the reference marker in at most 120 frames, after
/// TrackRecording(). The camera's response is that of the renderer, or, of scenes without objects,
/// that of the scene or of the film. A refusal is no error: `fit` and `exposure` have
/// its reason. Errors: an
/// unreadable frame or response, those of the monitor.
Result<MeasuredLens> MeasureLens(Pipeline& pipeline, const compositor::KnownLens& known,
                                 devices::Recording recording, const PassMonitor& monitor = {});

}  // namespace pleinair::session
