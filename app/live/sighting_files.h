#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/live/live_output.h"
#include "app/output/detections_writer.h"
#include "app/output/light_csv.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "session/pipeline.h"

namespace pleinair::app {

/// Writes the requested files of a live session: the tracker's observations, and the light of drawn
/// frames (in memory until Finish(), 80 bytes each).
class SightingFiles {
 public:
  /// `detections`: one line per frame. Errors: files that cannot be written, a lens model that a
  /// trajectory format cannot store.
  static Result<SightingFiles> Create(const std::optional<std::filesystem::path>& detections,
                                      const std::optional<LiveOutput::Options>& output,
                                      const CameraModel& camera,
                                      const scene::SceneDescription& scene);

  /// Adds a newly tracked frame. `since_first_ns`: time since the first frame.
  Result<void> Add(const session::TrackedFrame& tracked, const session::MarkerTracks& tracks,
                   std::int64_t frame_index, std::int64_t since_first_ns);

  /// Adds the light of a drawn frame. May run on another thread than Add().
  void AddLight(const LightRow& row) {
    if (output_) light_.push_back(row);
  }

  /// Ends the files. A second call has no effect. `start`: UTC of the first frame.
  void Finish(UtcTime start);

  /// The error of Finish().
  const std::optional<Error>& trouble() const { return trouble_; }

 private:
  std::optional<DetectionsWriter> detections_;
  std::unique_ptr<LiveOutput> output_;
  std::vector<LightRow> light_;  // Used by the drawing thread alone.
  std::optional<Error> trouble_;
};

}  // namespace pleinair::app
