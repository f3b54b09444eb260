#include "app/live/live_session.h"

#include <string>
#include <utility>

#include "app/drape/scene_ink.h"
#include "session/scene_marker.h"

namespace pleinair::app {
namespace {

using Clock = std::chrono::steady_clock;

// Observations kept per marker: enough to choose between two poses by the last one.
constexpr std::size_t kObservationsKept = 1000;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

WhenFull WhenLate(const LiveOptions& options) {
  return options.lossless ? WhenFull::kWait : WhenFull::kReplaceOldest;
}

}  // namespace

LiveSession::LiveSession(std::unique_ptr<devices::FrameSource> source, LiveOptions options)
    : options_(std::move(options)),
      source_(std::move(source)),
      scene_(options_.scene, options_.composer, options_.light),
      recording_(options_.camera),
      captured_(1, WhenLate(options_)),
      tracked_(1, WhenLate(options_)),
      clock_(options_.start) {}

Result<std::unique_ptr<LiveSession>> LiveSession::Create(
    std::unique_ptr<devices::FrameSource> source, LiveOptions options, const Loaded& loaded) {
  std::unique_ptr<LiveSession> session(new LiveSession(std::move(source), std::move(options)));
  PLEINAIR_RETURN_IF_ERROR(session->Prepare(loaded));
  return session;
}

Result<void> LiveSession::Prepare(const Loaded& loaded) {
  session::PipelineOptions pipeline{.composer = options_.composer, .light = options_.light};
  pipeline.refine_markers = options_.lossless || options_.output;
  if (!options_.lossless) pipeline.kept_observations = kObservationsKept;
  pipeline.places_anchors_in_background = !options_.lossless;
  PLEINAIR_ASSIGN_OR_RETURN(pipeline_,
                            session::Pipeline::Create(options_.camera, options_.scene, pipeline));
  PLEINAIR_ASSIGN_OR_RETURN(const auto ink, DrawMaps(options_.scene, pipeline_.get()));
  if (loaded) loaded(ink ? ink->warnings() : std::vector<std::string>());
  if (options_.record) PLEINAIR_RETURN_IF_ERROR(recording_.Start(*options_.record));
  PLEINAIR_ASSIGN_OR_RETURN(sightings_, SightingFiles::Create(options_.detections, options_.output,
                                                              options_.camera, options_.scene));
  session::SceneRenderer& renderer = pipeline_->renderer();
  if (!options_.lossless && renderer.DrawsObjects()) {
    scene_.StartFollowing(options_.camera, options_.light, renderer);
  }
  if (options_.lossless && options_.source.trajectory) options_.source.trajectory->Wait();
  threads_.emplace_back([this] { Capture(); });
  threads_.emplace_back([this] { Track(); });
  // The first frame is tracked meanwhile.
  if (options_.lossless || !renderer.DrawsObjects()) return {};
  return scene_.StartLight(options_.camera, options_.light,
                           options_.start.value_or(FrameClock::Now()), &renderer);
}

LiveSession::~LiveSession() { Stop(); }

void LiveSession::Stop() {
  end_.Stop();
  if (options_.source.stop) options_.source.stop();
  captured_.Close();
  tracked_.Close();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
  while (captured_.Take()) counters_.GivenUp();
  while (tracked_.Take()) counters_.GivenUp();
  sightings_.Finish(clock_.first_moment());
  scene_.Stop();
  recording_.Stop();
}

void LiveSession::Capture() {
  while (!end_.stopping()) {
    auto next = source_->Next();
    if (!next) {
      end_.Fail(next.error());
      break;
    }
    if (!*next) break;
    const auto frame = std::make_shared<const devices::Frame>(*std::move(*next));
    if (const auto size = CheckSize(*frame); !size) {
      end_.Fail(size.error());
      break;
    }
    counters_.Captured(*frame, clock_.Add(frame->timestamp_ns));
    recording_.Add(frame, clock_.MomentOf(frame->timestamp_ns),
                   [this] { return options_.lossless ? options_.scene : scene_.Edited(); });
    if (!captured_.Give(frame)) {
      counters_.GivenUp();
      break;
    }
  }
  captured_.Close();
}

Result<void> LiveSession::CheckSize(const devices::Frame& frame) const {
  const CameraModel& camera = options_.camera;
  if (frame.rgb.width() == camera.width && frame.rgb.height() == camera.height) return {};
  return InputError("the camera",
                    "sends " + std::to_string(frame.rgb.width()) + "x" +
                        std::to_string(frame.rgb.height()) +
                        " pixels, but the calibration is for " + std::to_string(camera.width) +
                        "x" + std::to_string(camera.height),
                    "calibrate the camera at a size that it sends");
}

void LiveSession::Track() {
  while (auto frame = captured_.Take()) {
    if (end_.stopping()) {
      counters_.GivenUp();
      break;
    }
    const auto start = Clock::now();
    auto tracked = TrackOne(*std::move(frame));
    if (!tracked) {
      end_.Fail(tracked.error());
      counters_.GivenUp();
      break;
    }
    counters_.Tracked(tracked->pose.has_value(), MillisecondsSince(start));
    if (!tracked_.Give(*std::move(tracked))) {
      counters_.GivenUp();
      break;
    }
  }
  tracked_.Close();
}

Result<LiveSession::Tracked> LiveSession::TrackOne(FramePtr frame) {
  PLEINAIR_ASSIGN_OR_RETURN(const session::TrackedFrame tracked, pipeline_->Track(*frame));
  const session::MarkerTracks& tracks = pipeline_->tracks();
  PLEINAIR_RETURN_IF_ERROR(
      sightings_.Add(tracked, tracks, frame->index, clock_.SinceFirst_ns(frame->timestamp_ns)));
  std::optional<session::CameraPose> pose = pipeline_->FollowIn(*frame);
  if (options_.source.trajectory) pose = options_.source.trajectory->PoseIn(*frame, pose);
  if (pose && session::ShowsReferenceMarker(pose->observation)) {
    scene_.Follow(frame, pose->observation.camera_from_marker,
                  session::MarkerReflectanceOf(options_.scene.marker, pose->marker));
  }
  return Tracked{std::move(frame), tracks.ReferenceMarker(), std::move(pose)};
}

void LiveSession::Edit(const session::SceneEdit& edit) { scene_.Edit(edit); }

Result<std::optional<DrawnFrame>> LiveSession::Draw(std::chrono::milliseconds limit) {
  std::optional<Tracked> next = tracked_.TakeWithin(limit);
  if (const std::optional<Error> error = end_.error()) {
    if (next) counters_.GivenUp();
    return tl::make_unexpected(*error);
  }
  if (!next) return std::nullopt;
  auto drawn = DrawOne(*std::move(next));
  if (!drawn) counters_.GivenUp();
  return drawn;
}

Result<std::optional<DrawnFrame>> LiveSession::DrawOne(Tracked tracked) {
  const auto start = Clock::now();
  const devices::Frame& frame = *tracked.frame;
  const UtcTime moment = clock_.MomentOf(frame.timestamp_ns);
  session::SceneRenderer& renderer = pipeline_->renderer();
  if (tracked.reference_marker && pipeline_->MeterLightOn(*tracked.reference_marker)) {
    scene_.SetMarkerReflectance(
        session::MarkerReflectanceOf(options_.scene.marker, *tracked.reference_marker));
  }
  if (!options_.lossless) PLEINAIR_RETURN_IF_ERROR(scene_.Update(moment, &renderer));
  DrawnFrame drawn{tracked.frame, std::nullopt, {}, moment, {}};
  if (tracked.pose) {
    drawn.camera_from_marker = tracked.pose->observation.camera_from_marker;
    // Without the marker there is no exposure to compare shadows with.
    if (session::ShowsReferenceMarker(tracked.pose->observation)) {
      scene_.Show(tracked.frame, *drawn.camera_from_marker, moment);
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(session::ComposedFrame composed,
                            pipeline_->Compose(devices::ImageOf(frame), tracked.pose, moment,
                                               scene_.FollowedIn(frame.index)));
  drawn.picture = std::move(composed.image);
  drawn.light = renderer.light();
  if (composed.light) {
    sightings_.AddLight(
        LightRowOf(frame.index, clock_.SinceFirst_ns(frame.timestamp_ns), *composed.light));
  }
  counters_.Drawn(renderer.times(), MillisecondsSince(start));
  if (tracked.pose) counters_.Composed(1e-3 * MillisecondsSince(options_.began));
  if (options_.lossless) return drawn;
  if (!options_.shown_elsewhere) counters_.AddLatency(frame);
  if (renderer.DrawsObjects()) {
    scene_.NoteDrawn(renderer.times().compose_ms, counters_.period_ms());
  }
  return drawn;
}

void LiveSession::Shown(const DrawnFrame& frame, std::int64_t late_for_screen) {
  counters_.Shown(late_for_screen);
  counters_.AddLatency(*frame.frame);
}

LiveStatistics LiveSession::statistics() const {
  LiveStatistics statistics = counters_.Snapshot([this] {
    return LateFrames{captured_.dropped(), tracked_.dropped(), 0};
  });
  statistics.detail = scene_.detail();
  if (const auto progress = scene_.light_progress()) statistics.light = *progress;
  statistics.recording = recording_.counts();
  return statistics;
}

bool LiveSession::FailedToKeepLight() const {
  const auto progress = scene_.light_progress();
  return progress ? progress->failed_to_keep : pipeline_->renderer().FailedToKeepLight();
}

}  // namespace pleinair::app
