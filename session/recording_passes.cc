#include "session/recording_passes.h"

#include <algorithm>
#include <cstddef>
#include <future>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "session/frame_prefetch.h"
#include "session/light_frames.h"
#include "session/motion/pose_motion.h"
#include "session/scene_renderer.h"

namespace pleinair::session {
namespace {

// Frames whose marker poses are measured at once: enough for all processors, few enough for memory.
constexpr std::size_t kMeasuredTogether = 8;

/// Progress and stage times of one pass, with or without a monitor.
class Pass {
 public:
  explicit Pass(const PassMonitor& monitor)
      : monitor_(monitor), times_(monitor.times != nullptr ? *monitor.times : unused_) {}

  Result<void> Report(std::int64_t done, std::optional<std::int64_t> of) const {
    return monitor_.progress ? monitor_.progress(done, of) : Result<void>();
  }
  StageTimes& times() { return times_; }

 private:
  const PassMonitor& monitor_;
  StageTimes unused_;
  StageTimes& times_;
};

/// Checks that UtcTime can represent a frame's time; some recordings' time stamps run for
/// centuries.
Result<void> CheckMoment(const Pipeline& pipeline, const std::string& recording,
                         const devices::Frame& frame) {
  std::int64_t moment_ns = 0;
  if (!__builtin_add_overflow(pipeline.scene().place_time.start.nanoseconds_since_1970(),
                              frame.timestamp_ns, &moment_ns)) {
    return {};
  }
  return InputError(recording,
                    "frame " + std::to_string(frame.index) + " lies beyond the years 1678 to 2261",
                    "correct the scene's time, or the recording's frame rate or time stamps");
}

/// Measures found frames and passes them on.
Result<void> MeasureTogether(Pipeline& pipeline, std::vector<FoundFrame> found,
                             const TrackedFrameCallback& take, StageTimes* times) {
  StageTimes together;
  std::vector<TrackedFrame> tracked =
      together.Measure("measure", [&] { return pipeline.Measure(found); });
  const double each_ms = together.Summarize()[0].total_ms / static_cast<double>(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    times->Add("measure", each_ms);
    if (take) PLEINAIR_RETURN_IF_ERROR(take(found[i].frame, std::move(tracked[i])));
  }
  return {};
}

void Resize(const Pipeline& pipeline, devices::Frame* frame, StageTimes* times) {
  if (pipeline.HasOutputSize(*frame)) return;
  times->Measure("resize", [&] {
    pipeline.Resize(frame);
    return 0;
  });
}

/// The frames whose light is observed: those that show the marker, which gives their exposure. With
/// a given trajectory, all frames count if none shows it.
std::vector<Observation> PathOf(const Pipeline& pipeline) {
  if (pipeline.trajectory_summary()) {
    std::vector<Observation> path = pipeline.Path();
    if (std::any_of(path.begin(), path.end(), ShowsReferenceMarker)) {
      std::erase_if(path, [](const Observation& at) { return !ShowsReferenceMarker(at); });
    }
    return path;
  }
  const std::optional<MarkerName> marker = pipeline.tracks().ReferenceMarker();
  return marker ? pipeline.tracks().TrackOf(*marker) : std::vector<Observation>();
}

/// Estimates the changes of the light about that of the `reference` frames; `chosen` are indices of
/// the path, whose middle gives the time.
void FollowLight(Pipeline& pipeline, const std::vector<Observation>& path,
                 const std::vector<std::size_t>& chosen, const std::set<std::int64_t>& reference) {
  pipeline.renderer().FollowLight(pipeline.MomentOf(path[chosen[chosen.size() / 2]].timestamp_ns),
                                  reference);
}

bool LightChanges(Pipeline& pipeline) {
  const LightFollower* follower = pipeline.renderer().light_follower();
  return pipeline.FollowsLight() && follower != nullptr && follower->changes();
}

/// The frames with a pose in which no cloud takes the sun. The light of the recording is estimated
/// from them, as if it were constant.
std::vector<Observation> PathInFullSun(Pipeline& pipeline) {
  std::vector<Observation> path = PathOf(pipeline);
  if (!LightChanges(pipeline)) return path;
  const std::set<std::int64_t> sunny = pipeline.renderer().light_follower()->FramesInFullSun();
  std::erase_if(path, [&](const Observation& at) { return !sunny.contains(at.frame_index); });
  return path;
}

std::set<std::int64_t> FramesOf(const std::vector<Observation>& path,
                                const std::vector<std::size_t>& chosen) {
  std::set<std::int64_t> frames;
  for (const std::size_t i : chosen) frames.insert(path[i].frame_index);
  return frames;
}

void AddTimes(const ComposedFrame& composed, StageTimes* times) {
  if (!composed.light) return;
  if (composed.times.light_ms > 1.0) times->Add("light", composed.times.light_ms);
  if (composed.times.animation_ms > 0.1) times->Add("animate", composed.times.animation_ms);
  times->Add("estimate exposure", composed.times.meter_ms);
  times->Add("compose", composed.times.compose_ms);
}

}  // namespace

Result<void> TrackRecording(Pipeline& pipeline, devices::Recording recording,
                            const TrackedFrameCallback& take, const PassMonitor& monitor) {
  Pass pass(monitor);
  const std::string name = recording.path.string();
  FramePrefetcher frames(std::move(recording.frames));
  const std::optional<std::int64_t> count = frames.FrameCount();
  std::int64_t done = 0;
  std::vector<FoundFrame> found;
  StageTimes measuring_times;  // Used by the measuring thread while it runs.
  // Measuring uses all processors, finding uses one. While some frames are measured, the next ones
  // are searched. Last: it uses the others.
  std::future<Result<void>> measuring;
  const auto finish_measuring = [&]() -> Result<void> {
    return measuring.valid() ? measuring.get() : Result<void>();
  };
  for (bool more = true; more;) {
    PLEINAIR_RETURN_IF_ERROR(pass.Report(done, count));
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame, frames.Next());
    more = frame.has_value();
    if (more) {
      PLEINAIR_RETURN_IF_ERROR(CheckMoment(pipeline, name, *frame));
      PLEINAIR_ASSIGN_OR_RETURN(auto one, pass.times().Measure("track", [&] {
        return pipeline.Find(*std::move(frame));
      }));
      found.push_back(std::move(one));
    }
    if (more && found.size() < kMeasuredTogether) continue;
    PLEINAIR_RETURN_IF_ERROR(finish_measuring());
    done += static_cast<std::int64_t>(found.size());
    measuring = std::async(std::launch::async, [&, together = std::exchange(found, {})]() mutable {
      return MeasureTogether(pipeline, std::move(together), take, &measuring_times);
    });
  }
  PLEINAIR_RETURN_IF_ERROR(finish_measuring());
  PLEINAIR_RETURN_IF_ERROR(pass.Report(done, count));
  pass.times().Add(measuring_times);
  pass.times().Add(frames.Finish());
  if (done == 0) return InputError(name, "holds no frames", "record it again");
  if (pipeline.has_anchors()) {
    pass.times().Measure("follow anchors", [&] {
      pipeline.FollowAnchors();
      return 0;
    });
  }
  return {};
}

Result<void> EstimateResponse(Pipeline& pipeline) {
  const std::vector<Observation> all = PathOf(pipeline);
  const std::vector<std::size_t> first = LightFrames(all);
  if (first.empty() || pipeline.renderer().light_follower() == nullptr) return {};
  FollowLight(pipeline, all, first, {});
  const std::vector<Observation> path = PathInFullSun(pipeline);
  PLEINAIR_RETURN_IF_ERROR(pipeline.renderer().EstimateResponse(FramesOf(path, LightFrames(path))));
  // By another response the frames show other light.
  if (pipeline.renderer().light().response.source == ResponseSummary::Source::kMeasured) {
    FollowLight(pipeline, all, first, {});
  }
  return {};
}

Result<void> EstimateLight(Pipeline& pipeline, devices::Recording recording,
                           const PassMonitor& monitor) {
  Pass pass(monitor);
  PLEINAIR_RETURN_IF_ERROR(
      pass.times().Measure("follow light", [&] { return EstimateResponse(pipeline); }));
  const std::vector<Observation> path = PathInFullSun(pipeline);
  const std::vector<std::size_t> chosen = LightFrames(path);
  if (chosen.empty() || !pipeline.renderer().CanMeasureLight()) return {};
  pipeline.MeterLightOn(*pipeline.PathMarker());
  const auto count = static_cast<std::int64_t>(chosen.size());
  std::int64_t done = 0;
  for (auto next = chosen.begin(); next != chosen.end();) {
    const Observation& at = path[*next];
    recording.frames->SkipTo(at.frame_index);
    PLEINAIR_RETURN_IF_ERROR(pass.Report(done, count));
    PLEINAIR_ASSIGN_OR_RETURN(
        std::optional<devices::Frame> frame,
        pass.times().Measure("read", [&] { return recording.frames->Next(); }));
    if (!frame) break;
    if (frame->index != at.frame_index) continue;
    ++next;
    ++done;
    Resize(pipeline, &*frame, &pass.times());
    pass.times().Measure("observe light", [&] {
      pipeline.renderer().ObserveLight(devices::ImageOf(*frame), at.camera_from_marker,
                                       pipeline.MomentOf(frame->timestamp_ns),
                                       ShowsReferenceMarker(at));
      return 0;
    });
  }
  PLEINAIR_RETURN_IF_ERROR(pass.Report(done, count));
  PLEINAIR_RETURN_IF_ERROR(
      pass.times().Measure("estimate light", [&] { return pipeline.renderer().EstimateLight(); }));
  pass.times().Measure("follow light", [&] {
    if (LightChanges(pipeline)) FollowLight(pipeline, path, chosen, FramesOf(path, chosen));
    return 0;
  });
  return {};
}

Result<void> ComposeFrames(Pipeline& pipeline, devices::Recording recording,
                           const ComposedFrameCallback& take, const PassMonitor& monitor,
                           const EarlierImage& earlier) {
  Pass pass(monitor);
  const std::string name = recording.path.string();
  const std::int64_t count = pipeline.tracks().frames();
  const std::optional<MarkerName> marker = pipeline.PathMarker();
  const std::vector<Observation>& path = pipeline.Path();
  FramePrefetcher frames(std::move(recording.frames));
  auto at = path.begin();
  for (std::int64_t done = 0;; ++done) {
    PLEINAIR_RETURN_IF_ERROR(pass.Report(done, count));
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame, frames.Next());
    if (!frame && done != count) {
      return InputError(name, "changed while it was being replayed",
                        "replay it again when nothing writes to it");
    }
    if (!frame) break;
    Resize(pipeline, &*frame, &pass.times());
    while (at != path.end() && at->frame_index < frame->index) ++at;
    std::optional<CameraPose> pose;
    if (at != path.end() && at->frame_index == frame->index) {
      pose = CameraPose{*marker, *at};
      pose->exposure_s = frame->settings.exposure_s;
      if (!pipeline.renderer().exposure().IsOff()) {
        pose->motion = MotionAbout(path, static_cast<std::size_t>(at - path.begin()));
      }
    }
    std::optional<RgbImage> image = earlier ? earlier(frame->index) : std::nullopt;
    const UtcTime moment = pipeline.MomentOf(frame->timestamp_ns);
    PLEINAIR_ASSIGN_OR_RETURN(ComposedFrame composed,
                              image ? pipeline.Advance(devices::ImageOf(*frame), pose, moment)
                                    : pipeline.Compose(devices::ImageOf(*frame), pose, moment));
    if (image) composed.image = *std::move(image);
    AddTimes(composed, &pass.times());
    PLEINAIR_RETURN_IF_ERROR(take(*frame, std::move(composed)));
  }
  pass.times().Add(frames.Finish());
  return {};
}

Result<void> ComposeRecording(const std::filesystem::path& recording,
                              const PipelineOptions& options, const ComposedFrameCallback& take) {
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording opened, devices::OpenRecording(recording));
  if (!opened.scene) {
    return InputError(recording.string(), "has no scene",
                      "write one (docs/guide/reference/recordings.md) beside its frames");
  }
  PipelineOptions by_film = options;
  if (!by_film.light.film_response) {
    by_film.light.film_response = devices::ResponseOf(opened.curve);
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::unique_ptr<Pipeline> pipeline,
                            Pipeline::Create(opened.camera, *opened.scene, by_film));
  PLEINAIR_RETURN_IF_ERROR(TrackRecording(*pipeline, std::move(opened)));
  PLEINAIR_ASSIGN_OR_RETURN(opened, devices::OpenRecording(recording));
  PLEINAIR_RETURN_IF_ERROR(EstimateLight(*pipeline, std::move(opened)));
  PLEINAIR_ASSIGN_OR_RETURN(opened, devices::OpenRecording(recording));
  return ComposeFrames(*pipeline, std::move(opened), take);
}

}  // namespace pleinair::session
