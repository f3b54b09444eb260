#include "app/live/sighting_files.h"

#include <string>
#include <utility>

namespace pleinair::app {

Result<SightingFiles> SightingFiles::Create(const std::optional<std::filesystem::path>& detections,
                                            const std::optional<LiveOutput::Options>& output,
                                            const CameraModel& camera,
                                            const scene::SceneDescription& scene) {
  SightingFiles files;
  if (detections) {
    PLEINAIR_ASSIGN_OR_RETURN(files.detections_, DetectionsWriter::Create(*detections));
  }
  if (output) {
    PLEINAIR_ASSIGN_OR_RETURN(files.output_, LiveOutput::Create(*output, camera, scene));
  }
  return files;
}

Result<void> SightingFiles::Add(const session::TrackedFrame& tracked,
                                const session::MarkerTracks& tracks, std::int64_t frame_index,
                                std::int64_t since_first_ns) {
  if (!detections_ && !output_) return {};
  const std::string line =
      DetectionsWriter::Line(frame_index, since_first_ns, tracked.observations, tracked.lost);
  if (detections_) PLEINAIR_RETURN_IF_ERROR(detections_->Add(line));
  if (output_) return output_->Add(tracks, frame_index, since_first_ns, line);
  return {};
}

void SightingFiles::Finish(UtcTime start) {
  Result<void> finished;
  if (detections_) finished = detections_->Finish();
  detections_.reset();
  if (finished && output_) finished = output_->Finish(start, light_);
  output_.reset();
  if (!finished) trouble_ = finished.error();
}

}  // namespace pleinair::app
