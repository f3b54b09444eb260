#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/live/live_output.h"
#include "app/output/detections_writer.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/utc_time.h"
#include "scene/scene_description.h"
#include "session/marker_tracks.h"
#include "session/pipeline.h"

namespace pleinair::app {

/// The requested files with the tracker's observations in a live session.
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

  /// Ends the files. A second call has no effect. `start`: UTC of the first frame.
  void Finish(UtcTime start);

  /// The error of Finish().
  const std::optional<Error>& trouble() const { return trouble_; }

 private:
  std::optional<DetectionsWriter> detections_;
  std::unique_ptr<LiveOutput> output_;
  std::optional<Error> trouble_;
};

}  // namespace pleinair::app
