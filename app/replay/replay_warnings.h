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

/// What the user should know of how a replay's markers were found, a sentence each.
std::vector<std::string> MarkerWarnings(const ReplayReport& report,
                                        const session::MarkerTracks& marker_tracks,
                                        const scene::SceneDescription& scene);

/// What models' files have that does not show, a sentence a file.
std::vector<std::string> ModelWarnings(const std::vector<compositor::PlacedModel>& models);

/// What the renderer cannot do as well as it should: `samples` a pixel at objects' edges, nothing
/// where none are drawn.
std::vector<std::string> DrawingWarnings(std::optional<int> samples);

/// Where the light that was measured is far from what the scene says, cannot be what the frames
/// show, or was not measured.
std::vector<std::string> LightWarnings(const session::LightSummary& summary);

}  // namespace pleinair::app
