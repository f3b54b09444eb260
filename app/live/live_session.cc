#include "app/live/live_session.h"

#include <utility>

#include "app/output/detections_writer.h"
#include "session/scene_marker.h"

namespace pleinair::app {
namespace {

using Clock = std::chrono::steady_clock;

// Weight of the newest period in the running mean.
constexpr double kPeriodWeight = 0.1;
// What is kept of each marker's path: enough to choose between two poses by the last one.
constexpr std::size_t kObservationsKept = 1000;

std::int64_t Now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

UtcTime WallClock() {
  return UtcTime(std::chrono::duration_cast<std::chrono::nanoseconds>(
                     std::chrono::system_clock::now().time_since_epoch())
                     .count());
}

double Milliseconds(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

/// The file of what was seen.
class LiveSession::Detections {
 public:
  explicit Detections(DetectionsWriter writer) : writer_(std::move(writer)) {}
  DetectionsWriter& writer() { return writer_; }

 private:
  DetectionsWriter writer_;
};

LiveSession::LiveSession(std::unique_ptr<devices::FrameSource> source, LiveOptions options)
    : options_(std::move(options)),
      source_(std::move(source)),
      marker_tracks_(options_.scene.marker),
      recording_(options_.camera),
      captured_(1, options_.lossless ? WhenFull::kWait : WhenFull::kReplaceOldest),
      tracked_(1, options_.lossless ? WhenFull::kWait : WhenFull::kReplaceOldest) {}

Result<std::unique_ptr<LiveSession>> LiveSession::Create(
    std::unique_ptr<devices::FrameSource> source, LiveOptions options) {
  std::unique_ptr<LiveSession> session(new LiveSession(std::move(source), std::move(options)));
  PLEINAIR_RETURN_IF_ERROR(session->Prepare());
  LiveSession* self = session.get();
  self->threads_.emplace_back([self] { self->Capture(); });
  self->threads_.emplace_back([self] { self->Track(); });
  return session;
}

Result<void> LiveSession::Prepare() {
  if (options_.record) PLEINAIR_RETURN_IF_ERROR(recording_.Start(*options_.record));
  PLEINAIR_ASSIGN_OR_RETURN(const tracker::TrackerOptions tracking,
                            session::TrackingOf(options_.scene));
  PLEINAIR_ASSIGN_OR_RETURN(tracker_, tracker::Tracker::Create(options_.camera, tracking));
  PLEINAIR_ASSIGN_OR_RETURN(
      renderer_, session::SceneRenderer::Create(options_.camera, options_.scene, options_.composer,
                                                options_.light));
  if (options_.detections) {
    PLEINAIR_ASSIGN_OR_RETURN(DetectionsWriter writer,
                              DetectionsWriter::Create(*options_.detections));
    detections_ = std::make_unique<Detections>(std::move(writer));
  }
  if (options_.output) {
    PLEINAIR_ASSIGN_OR_RETURN(
        output_, LiveOutput::Create(*options_.output, options_.camera, options_.scene));
  }
  if (options_.lossless || options_.output) {
    refiner_.emplace(options_.camera, options_.scene.marker.size_m);
  }
  if (options_.lossless) return {};
  edit_ = session::UneditedScene(options_.scene, options_.composer, options_.light.convergence);
  if (!renderer_->DrawsObjects()) return {};
  const UtcTime start = options_.start.value_or(WallClock());
  PLEINAIR_ASSIGN_OR_RETURN(
      light_, session::BackgroundLight::Create(
                  {options_.camera, options_.scene, renderer_->placed(), options_.light, edit_,
                   renderer_->MakeLightingRequest(start).skies, start, renderer_->response()}));
  return renderer_->UseLight(light_->Take());
}

LiveSession::~LiveSession() { Stop(); }

void LiveSession::Stop() {
  stop_ = true;
  if (options_.stop_source) options_.stop_source();
  captured_.Close();
  tracked_.Close();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
  while (captured_.Take()) GiveUpFrame();
  while (tracked_.Take()) GiveUpFrame();
  FinishOutput();
  if (light_) light_->Stop();
  recording_.Stop();
}

void LiveSession::GiveUpFrame() {
  const std::lock_guard lock(mutex_);
  ++statistics_.on_the_way_at_end;
}

void LiveSession::FinishOutput() {
  Result<void> finished;
  if (detections_) finished = detections_->writer().Finish();
  detections_.reset();
  UtcTime start;
  {
    const std::lock_guard lock(mutex_);
    start = first_moment_;
  }
  if (finished && output_) finished = output_->Finish(start);
  output_.reset();
  const std::lock_guard lock(mutex_);
  if (!finished) output_trouble_ = finished.error();
}

void LiveSession::Fail(Error error) {
  const std::lock_guard lock(mutex_);
  if (!error_) error_ = std::move(error);
}

UtcTime LiveSession::MomentOf(const devices::Frame& frame) const {
  const std::lock_guard lock(mutex_);
  return UtcTime(first_moment_.nanoseconds_since_1970() + frame.timestamp_ns -
                 first_stamp_ns_.value_or(frame.timestamp_ns));
}

void LiveSession::Capture() {
  while (!stop_) {
    auto next = source_->Next();
    if (!next) {
      Fail(next.error());
      break;
    }
    if (!*next) break;
    const auto frame = std::make_shared<const devices::Frame>(*std::move(*next));
    if (frame->rgb.width() != options_.camera.width ||
        frame->rgb.height() != options_.camera.height) {
      Fail({ErrorKind::kInput, "the camera",
            "sends " + std::to_string(frame->rgb.width()) + "x" +
                std::to_string(frame->rgb.height()) + " pixels, but the calibration is for " +
                std::to_string(options_.camera.width) + "x" +
                std::to_string(options_.camera.height),
            "calibrate the camera at a size that it sends"});
      break;
    }
    {
      const std::lock_guard lock(mutex_);
      if (!first_stamp_ns_) {
        first_stamp_ns_ = frame->timestamp_ns;
        first_moment_ = options_.start.value_or(WallClock());
      }
      if (last_stamp_ns_) {
        const double period_ms = static_cast<double>(frame->timestamp_ns - *last_stamp_ns_) * 1e-6;
        double& mean_ms = statistics_.period_ms;
        mean_ms = mean_ms == 0.0 ? period_ms : mean_ms + kPeriodWeight * (period_ms - mean_ms);
      }
      last_stamp_ns_ = frame->timestamp_ns;
      ++statistics_.captured;
      statistics_.loss += frame->loss;
    }
    recording_.Add(frame, MomentOf(*frame), [this] { return SceneNow(); });
    if (!captured_.Give(frame)) {
      GiveUpFrame();
      break;
    }
  }
  captured_.Close();
}

scene::SceneDescription LiveSession::SceneNow() const {
  const std::lock_guard lock(mutex_);
  return options_.lossless ? options_.scene : session::WithEdit(options_.scene, edit_);
}

void LiveSession::Track() {
  while (auto frame = captured_.Take()) {
    if (stop_) {
      GiveUpFrame();
      break;
    }
    const auto start = Clock::now();
    auto tracked = TrackOne(*std::move(frame));
    if (!tracked) {
      Fail(tracked.error());
      GiveUpFrame();
      break;
    }
    {
      const std::lock_guard lock(mutex_);
      ++statistics_.tracked;
      if (tracked->camera_from_marker) ++statistics_.with_pose;
      statistics_.track_ms = Milliseconds(start);
    }
    if (!tracked_.Give(*std::move(tracked))) {
      GiveUpFrame();
      break;
    }
  }
  tracked_.Close();
}

Result<LiveSession::Tracked> LiveSession::TrackOne(FramePtr frame) {
  PLEINAIR_ASSIGN_OR_RETURN(auto observations, tracker_->Track(frame->grey.view()));
  if (refiner_) observations = refiner_->Measure(frame->grey.view(), std::move(observations));
  marker_tracks_.AddFrame(frame->index, frame->timestamp_ns, observations);
  if (!options_.lossless) marker_tracks_.ForgetAllBut(kObservationsKept);
  PLEINAIR_RETURN_IF_ERROR(WriteSightings(*frame, observations));
  Tracked tracked{std::move(frame), std::nullopt, marker_tracks_.ReferenceMarker(), {}};
  if (!tracked.reference_marker) return tracked;
  const std::vector<session::Observation>& path = marker_tracks_.TrackOf(*tracked.reference_marker);
  if (path.back().frame_index == tracked.frame->index) {
    tracked.camera_from_marker = path.back().camera_from_marker;
    if (options_.light.hands_in_front) {
      tracked.cover =
          session::VisibilityOf(options_.scene.marker, *tracked.reference_marker, path.back());
    }
  }
  return tracked;
}

Result<void> LiveSession::WriteSightings(
    const devices::Frame& frame, const std::vector<tracker::MarkerObservation>& observations) {
  if (!detections_ && !output_) return {};
  std::int64_t since_start_ns = frame.timestamp_ns;
  {
    const std::lock_guard lock(mutex_);
    since_start_ns -= first_stamp_ns_.value_or(0);
  }
  const std::string line =
      DetectionsWriter::Line(frame.index, since_start_ns, observations, tracker_->Lost());
  if (detections_) PLEINAIR_RETURN_IF_ERROR(detections_->writer().Add(line));
  if (output_) {
    PLEINAIR_RETURN_IF_ERROR(output_->Add(marker_tracks_, frame.index, since_start_ns, line));
  }
  return {};
}

void LiveSession::Edit(const session::SceneEdit& edit) {
  const std::lock_guard lock(mutex_);
  edit_ = edit;
  edited_ = true;
}

/// Edits since the last frame, and the light made since.
Result<void> LiveSession::TakeEdit(const devices::Frame& frame) {
  if (options_.lossless) return {};
  std::optional<session::SceneEdit> edit;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(edited_, false)) edit = edit_;
  }
  if (edit) {
    session::SceneEdit drawn = *edit;
    drawn.drawing = detail_.Apply(*edit);
    PLEINAIR_RETURN_IF_ERROR(renderer_->Edit(drawn));
    if (light_) light_->SetEdit(*edit);
  }
  if (!light_) return {};
  light_->SetTime(MomentOf(frame));
  if (auto light = light_->Take()) return renderer_->UseLight(std::move(light));
  return {};
}

Result<std::optional<DrawnFrame>> LiveSession::Draw(std::chrono::milliseconds limit) {
  std::optional<Tracked> next = tracked_.TakeWithin(limit);
  {
    const std::lock_guard lock(mutex_);
    if (error_) {
      if (next) ++statistics_.on_the_way_at_end;
      return tl::make_unexpected(*error_);
    }
  }
  if (!next) return std::nullopt;
  auto drawn = DrawOne(*std::move(next));
  if (!drawn) GiveUpFrame();
  return drawn;
}

Result<std::optional<DrawnFrame>> LiveSession::DrawOne(Tracked tracked) {
  const auto start = Clock::now();
  const UtcTime moment = MomentOf(*tracked.frame);
  if (tracked.reference_marker && tracked.reference_marker != shown_reference_marker_) {
    const scene::MarkerReflectance marker_reflectance =
        session::MarkerReflectanceOf(options_.scene.marker, *tracked.reference_marker);
    renderer_->SetMarkerReflectance(marker_reflectance);
    if (light_) light_->SetMarkerReflectance(marker_reflectance);
    shown_reference_marker_ = tracked.reference_marker;
  }
  PLEINAIR_RETURN_IF_ERROR(TakeEdit(*tracked.frame));
  DrawnFrame drawn{tracked.frame, tracked.camera_from_marker, {}, moment, {}};
  if (tracked.camera_from_marker) {
    if (light_) light_->Show(tracked.frame, *tracked.camera_from_marker, moment);
    PLEINAIR_ASSIGN_OR_RETURN(
        drawn.picture, renderer_->Render(tracked.frame->rgb.view(), *tracked.camera_from_marker,
                                         moment, tracked.cover));
  } else {
    drawn.picture = tracked.frame->rgb;
  }
  drawn.light = renderer_->light();
  CountDrawn(*tracked.frame, Milliseconds(start));
  return drawn;
}

void LiveSession::CountDrawn(const devices::Frame& frame, double draw_ms) {
  const std::lock_guard lock(mutex_);
  ++statistics_.drawn;
  statistics_.draw_ms = draw_ms;
  statistics_.render = renderer_->times();
  if (options_.lossless) return;
  if (!options_.shown_elsewhere) CountLatency(frame);
  const bool draws = renderer_->DrawsObjects() && edit_.detail == session::Detail::kAutomatic;
  if (draws && detail_.Add(statistics_.render.compose_ms, statistics_.period_ms)) edited_ = true;
}

void LiveSession::Shown(const DrawnFrame& frame, std::int64_t late_for_screen) {
  const std::lock_guard lock(mutex_);
  ++statistics_.shown;
  statistics_.late_for_screen = late_for_screen;
  CountLatency(*frame.frame);
}

/// Up to now. Under the mutex.
void LiveSession::CountLatency(const devices::Frame& frame) {
  const double latency_ms = static_cast<double>(Now_ns() - frame.timestamp_ns) * 1e-6;
  latency_.Add(latency_ms);
  latencies_.Add(latency_ms);
}

LatencyHistogram LiveSession::TakeLatencies() {
  const std::lock_guard lock(mutex_);
  return std::exchange(latencies_, {});
}

LiveStatistics LiveSession::statistics() const {
  const std::lock_guard lock(mutex_);
  LiveStatistics statistics = statistics_;
  statistics.late_for_tracking = captured_.dropped();
  statistics.late_for_drawing = tracked_.dropped();
  statistics.latency = latency_.Summarize();
  statistics.detail = detail_.detail();
  if (light_) statistics.light = light_->progress();
  const RecordingSwitch::Counts recording = recording_.counts();
  statistics.recorded = recording.recorded;
  statistics.left_out_of_recording = recording.left_out;
  return statistics;
}

bool LiveSession::FailedToKeepLight() const {
  return light_ ? light_->progress().failed_to_keep : renderer_->FailedToKeepLight();
}

std::optional<Error> LiveSession::output_trouble() const {
  const std::lock_guard lock(mutex_);
  return output_trouble_;
}

}  // namespace pleinair::app
