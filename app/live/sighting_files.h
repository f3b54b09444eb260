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

/// The files that a live session writes of what its tracker sees, as far as they are asked for.
class SightingFiles {
 public:
  /// `detections`: a line a frame. Errors: what cannot be written, a lens that a form of the path
  /// cannot hold.
  static Result<SightingFiles> Create(const std::optional<std::filesystem::path>& detections,
                                      const std::optional<LiveOutput::Options>& output,
                                      const CameraModel& camera,
                                      const scene::SceneDescription& scene);

  /// Adds a frame that was just tracked, so long after the first.
  Result<void> Add(const session::TrackedFrame& tracked, const session::MarkerTracks& tracks,
                   std::int64_t frame_index, std::int64_t since_first_ns);

  /// Ends the files; a second call does nothing. `start`: of the first frame.
  void Finish(UtcTime start);

  /// Why Finish() could not write them.
  const std::optional<Error>& trouble() const { return trouble_; }

 private:
  std::optional<DetectionsWriter> detections_;
  std::unique_ptr<LiveOutput> output_;
  std::optional<Error> trouble_;
};

}  // namespace pleinair::app
