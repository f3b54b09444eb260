#include "app/project/first_picture.h"

#include <iterator>
#include <optional>
#include <utility>

#include "app/replay/placement_warnings.h"
#include "app/replay/replay_warnings.h"
#include "app/terminal/interrupt.h"
#include "devices/recordings/frame_range.h"
#include "devices/recordings/image_sequence.h"
#include "devices/recordings/recording.h"
#include "devices/recordings/video_file.h"
#include "session/pipeline.h"
#include "session/recording_passes.h"
#include "session/scene_renderer.h"

namespace pleinair::app {
namespace {

/// The frame as a recording with the scene.
Result<devices::Recording> OneFrame(const FilmLook& look, std::int64_t frame,
                                    const scene::SceneDescription& scene) {
  devices::Recording recording;
  recording.path = look.file;
  recording.camera = look.lens.camera;
  recording.scene = scene;
  const ImageSize size{recording.camera.width, recording.camera.height};
  if (look.is_photo) {
    recording.frame_rate_hz = 1.0;  // It appears nowhere.
    PLEINAIR_ASSIGN_OR_RETURN(recording.frames,
                              devices::OpenImageSequence({{look.file, 0, std::nullopt}}, size));
    return recording;
  }
  devices::VideoMetadata facts;
  facts.size = size;
  PLEINAIR_ASSIGN_OR_RETURN(devices::OpenedVideo video, devices::OpenVideo(look.file, facts));
  recording.frame_rate_hz = video.frame_rate_hz;
  recording.curve = video.curve;
  devices::FrameRange range;
  range.frame = frame;
  recording.frames = devices::LimitFrames(std::move(video.frames), range, look.file.string());
  return recording;
}

void AddSentences(std::vector<std::string> sentences, std::vector<std::string>* all) {
  std::move(sentences.begin(), sentences.end(), std::back_inserter(*all));
}

}  // namespace

Result<FirstPicture> ComposeFirstPicture(const FilmLook& look, std::int64_t frame,
                                         const scene::SceneDescription& scene) {
  const session::PassMonitor monitor{
      [&](std::int64_t, std::optional<std::int64_t>) { return CheckInterrupt(look.file.string()); },
      nullptr};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, OneFrame(look, frame, scene));
  session::PipelineOptions options;
  // A tenth to a fifth of a replay's: the picture comes seconds earlier and looks the same.
  options.light.overrides.max_patches = 20'000;
  options.light.film_response = devices::ResponseOf(recording.curve);
  PLEINAIR_ASSIGN_OR_RETURN(const auto pipeline,
                            session::Pipeline::Create(recording.camera, scene, options));
  PLEINAIR_RETURN_IF_ERROR(session::TrackRecording(*pipeline, std::move(recording), {}, monitor));
  PLEINAIR_ASSIGN_OR_RETURN(recording, OneFrame(look, frame, scene));
  PLEINAIR_RETURN_IF_ERROR(session::EstimateLight(*pipeline, std::move(recording), monitor));
  PLEINAIR_ASSIGN_OR_RETURN(recording, OneFrame(look, frame, scene));
  FirstPicture picture;
  std::optional<session::LightSummary> light;
  const auto take = [&](const devices::Frame&, session::ComposedFrame composed) -> Result<void> {
    picture.image = std::move(composed.image);
    light = composed.light;
    return {};
  };
  PLEINAIR_RETURN_IF_ERROR(session::ComposeFrames(*pipeline, std::move(recording), take, monitor));
  if (const auto marker = pipeline->tracks().ReferenceMarker()) {
    const session::SceneRenderer& renderer = pipeline->renderer();
    AddSentences(ModelWarnings(renderer.placed()), &picture.warnings);
    AddSentences(PlacementWarnings(renderer.placed(), scene,
                                   {pipeline->output_camera(), pipeline->tracks().TrackOf(*marker)},
                                   renderer.phantom_rays()),
                 &picture.warnings);
    if (light) AddSentences(LightWarnings(*light), &picture.warnings);
  }
  return picture;
}

}  // namespace pleinair::app
