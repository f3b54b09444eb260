#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/replay/report/report.h"
#include "compositor/models/placed_model.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// Gathers what a tracker says frame by frame, so that the user reads each thing once.
class FrameWarnings {
 public:
  /// What was said of one frame; frames come in order.
  void Add(std::int64_t frame_index, const std::vector<std::string>& warnings);

  /// "In 12 frames, the first being 3, …": in the order in which they first came up, the first few.
  std::vector<std::string> Sentences() const;

 private:
  struct Entry {
    std::string text;
    std::int64_t first_frame = 0, last_frame = 0, frames = 0;
  };
  std::vector<Entry> entries_;
};

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
