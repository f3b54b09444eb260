#include "app/live/live_session.h"

#include <system_error>
#include <utility>

#include "app/scene_marker.h"
#include "app/sinks/detections_writer.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The sun moves its own width in two minutes: looking every second is often enough.
constexpr std::chrono::milliseconds kLookAtSunEvery{1000};
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
      session_(options_.scene.marker),
      captured_(1, options_.lossless ? WhenFull::kWait : WhenFull::kReplaceOldest),
      tracked_(1, options_.lossless ? WhenFull::kWait : WhenFull::kReplaceOldest) {}

Result<std::unique_ptr<LiveSession>> LiveSession::Create(
    std::unique_ptr<devices::FrameSource> source, LiveOptions options) {
  std::unique_ptr<LiveSession> session(new LiveSession(std::move(source), std::move(options)));
  PLEINAIR_RETURN_IF_ERROR(session->Prepare());
  LiveSession* self = session.get();
  self->threads_.emplace_back([self] { self->Capture(); });
  self->threads_.emplace_back([self] { self->Track(); });
  // A lossless replay is to give the same pictures each time: the light is made while drawing.
  if (!self->options_.lossless) self->threads_.emplace_back([self] { self->MakeLight(); });
  return session;
}

Result<void> LiveSession::Prepare() {
  if (options_.record) {
    std::error_code error;
    if (fs::exists(*options_.record / "frames.pack", error)) {
      return InputError(options_.record->string(), "holds a recording already",
                        "record into another folder");
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(const tracker::TrackerOptions tracking, TrackingOf(options_.scene));
  PLEINAIR_ASSIGN_OR_RETURN(tracker_, tracker::Tracker::Create(options_.camera, tracking));
  PLEINAIR_ASSIGN_OR_RETURN(renderer_, SceneRenderer::Create(options_.camera, options_.scene,
                                                             options_.composer, options_.light));
  if (options_.detections) {
    PLEINAIR_ASSIGN_OR_RETURN(DetectionsWriter writer,
                              DetectionsWriter::Create(*options_.detections));
    detections_ = std::make_unique<Detections>(std::move(writer));
  }
  if (options_.lossless) {
    measurer_.emplace(options_.camera, options_.scene.marker.size_m);
    return {};
  }
  return renderer_->LightUp(options_.start.value_or(WallClock()));
}

LiveSession::~LiveSession() { Stop(); }

void LiveSession::Stop() {
  stop_ = true;
  if (options_.stop_source) options_.stop_source();
  captured_.Close();
  tracked_.Close();
  light_.Close();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
  if (detections_) {
    if (auto finished = detections_->writer().Finish(); !finished) Fail(finished.error());
    detections_.reset();
  }
  if (recorder_) {
    recorder_->Finish();
    const std::lock_guard lock(mutex_);
    statistics_.recorded = recorder_->recorded();
    if (!recording_trouble_) recording_trouble_ = recorder_->trouble();
  }
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
      ++statistics_.captured;
      statistics_.loss += frame->loss;
    }
    if (options_.record) Record(frame);
    if (!captured_.Give(frame)) break;
  }
  captured_.Close();
}

void LiveSession::Record(const FramePtr& frame) {
  if (recording_trouble()) return;
  if (!recorder_) {
    auto made =
        LiveRecorder::Create(*options_.record, options_.camera, options_.scene, MomentOf(*frame));
    const std::lock_guard lock(mutex_);
    if (!made) {
      recording_trouble_ = made.error();
      return;
    }
    recorder_ = *std::move(made);
  }
  recorder_->Add(frame);
}

void LiveSession::Track() {
  while (auto frame = captured_.Take()) {
    if (stop_) break;
    const auto start = Clock::now();
    auto tracked = TrackOne(*std::move(frame));
    if (!tracked) {
      Fail(tracked.error());
      break;
    }
    {
      const std::lock_guard lock(mutex_);
      ++statistics_.tracked;
      if (tracked->camera_from_marker) ++statistics_.with_pose;
      statistics_.track_ms = Milliseconds(start);
    }
    if (!tracked_.Give(*std::move(tracked))) break;
  }
  tracked_.Close();
}

Result<LiveSession::Tracked> LiveSession::TrackOne(FramePtr frame) {
  PLEINAIR_ASSIGN_OR_RETURN(auto sightings, tracker_->Track(frame->grey.view()));
  if (measurer_) sightings = measurer_->Measure(frame->grey.view(), std::move(sightings));
  session_.AddFrame(frame->index, frame->timestamp_ns, sightings);
  if (!options_.lossless) session_.ForgetAllBut(kObservationsKept);
  if (detections_) {
    std::int64_t since_start_ns = frame->timestamp_ns;
    {
      const std::lock_guard lock(mutex_);
      since_start_ns -= first_stamp_ns_.value_or(0);
    }
    PLEINAIR_RETURN_IF_ERROR(detections_->writer().Add(
        DetectionsWriter::Line(frame->index, since_start_ns, sightings, tracker_->Lost())));
  }
  Tracked tracked{std::move(frame), std::nullopt, session_.Anchor()};
  if (!tracked.anchor) return tracked;
  const std::vector<Observation>& path = session_.Path(*tracked.anchor);
  if (path.back().frame_index == tracked.frame->index) {
    tracked.camera_from_marker = path.back().camera_from_marker;
  }
  return tracked;
}

void LiveSession::MakeLight() {
  const std::int64_t started_ns = Now_ns();
  UtcTime lit = options_.start.value_or(WallClock());
  while (!stop_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::int64_t passed_ns = Now_ns() - started_ns;
    const UtcTime now = options_.start
                            ? UtcTime(options_.start->nanoseconds_since_1970() + passed_ns)
                            : WallClock();
    const std::chrono::nanoseconds since(now.nanoseconds_since_1970() -
                                         lit.nanoseconds_since_1970());
    if (since < kLookAtSunEvery || !renderer_->NeedsLight(lit, now)) continue;
    light_.Give(renderer_->PrepareLight(now));
    lit = now;
  }
}

Result<std::optional<DrawnFrame>> LiveSession::Draw(std::chrono::milliseconds limit) {
  std::optional<Tracked> next = tracked_.TakeWithin(limit);
  {
    const std::lock_guard lock(mutex_);
    if (error_) return tl::make_unexpected(*error_);
  }
  if (!next) return std::nullopt;
  const auto start = Clock::now();
  if (const auto light = light_.TakeWithin(std::chrono::milliseconds(0))) {
    PLEINAIR_RETURN_IF_ERROR(renderer_->UseLight(*light));
  }
  if (next->anchor && next->anchor != shown_anchor_) {
    renderer_->SetMarkerPrint(PrintOf(options_.scene.marker, *next->anchor));
    shown_anchor_ = next->anchor;
  }
  DrawnFrame drawn{next->frame, next->camera_from_marker, {}, {}};
  if (next->camera_from_marker) {
    PLEINAIR_ASSIGN_OR_RETURN(drawn.picture,
                              renderer_->Render(next->frame->rgb.view(), *next->camera_from_marker,
                                                MomentOf(*next->frame)));
  } else {
    drawn.picture = next->frame->rgb;
  }
  const std::lock_guard lock(mutex_);
  ++statistics_.drawn;
  statistics_.draw_ms = Milliseconds(start);
  if (!options_.lossless) {
    drawn.latency_ms = static_cast<double>(Now_ns() - next->frame->timestamp_ns) * 1e-6;
    latency_.Add(*drawn.latency_ms);
  }
  return drawn;
}

LiveStatistics LiveSession::statistics() const {
  const std::lock_guard lock(mutex_);
  LiveStatistics statistics = statistics_;
  statistics.late_for_tracking = captured_.dropped();
  statistics.late_for_drawing = tracked_.dropped();
  statistics.latency = latency_.Summarize();
  if (recorder_) {
    statistics.recorded = recorder_->recorded();
    statistics.left_out_of_recording = recorder_->left_out();
  }
  return statistics;
}

std::optional<Error> LiveSession::recording_trouble() const {
  const std::lock_guard lock(mutex_);
  if (recording_trouble_) return recording_trouble_;
  return recorder_ ? recorder_->trouble() : std::nullopt;
}

}  // namespace pleinair::app
