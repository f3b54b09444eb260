#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/replay/report/report.h"
#include "compositor/models/placed_model.h"
#include "scene/scene_description.h"
#include "session/light_summary.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// Warnings about the detection of the markers, one sentence each.
std::vector<std::string> MarkerWarnings(const ReplayReport& report,
                                        const session::MarkerTracks& marker_tracks,
                                        const scene::SceneDescription& scene);

/// Warnings about unsupported features of the model files, one sentence per file.
std::vector<std::string> ModelWarnings(const std::vector<compositor::PlacedModel>& models);

/// Warnings about the limits of the renderer. `samples`: samples per pixel at the edges of objects;
/// nothing if no object is drawn.
std::vector<std::string> DrawingWarnings(std::optional<int> samples);

/// The word for the sky that layers of clouds replace.
std::vector<std::string> CloudWarnings(const scene::SceneDescription& scene);

/// Warnings about the measured lens. `is_asked_for`: a failure to measure is one of them.
std::vector<std::string> LensWarnings(const compositor::FocusFit& fit, bool is_asked_for);

/// Why the exposure could not be measured.
std::string ExposureWarning(const compositor::ExposureFit& fit);

/// Warnings about the limits of drawn depth of field.
std::vector<std::string> BlurWarnings(const session::CameraSummary& drawn);

/// Warnings about the light estimate: far from the scene description, implausible for the frames,
/// or missing. `rows`: the light of all frames.
std::vector<std::string> LightWarnings(const session::LightSummary& summary,
                                       const std::vector<LightRow>& rows = {});

/// For a scene without objects. `replaces_own`: the scene replaces that of the recording.
std::string NoObjectWarning(bool replaces_own);

}  // namespace pleinair::app
