#include "app/live/live_trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "app/check/spread_frames.h"
#include "app/check/views_near_sample.h"
#include "app/replay/given_trajectory.h"
#include "app/replay/trajectory_warnings.h"
#include "app/terminal/interrupt.h"
#include "session/following/low_priority.h"
#include "session/motion/pose_motion.h"
#include "session/recording_passes.h"

namespace pleinair::app {
namespace {

/// As many as a check looks at: the marker may be in view for a second of a minute.
constexpr std::size_t kMaxSample = 96;
/// Frames on their way through a session are fewer.
constexpr std::size_t kRememberedFrames = 256;

}  // namespace

LiveTrajectory::LiveTrajectory(session::TrajectoryRequest request,
                               const scene::SceneDescription& scene, Opener open)
    : request_(std::move(request)), scene_(scene), open_(std::move(open)) {
  thread_ = std::thread([this] { Run(); });
}

LiveTrajectory::~LiveTrajectory() { Stop(); }

void LiveTrajectory::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  Wait();
}

void LiveTrajectory::Wait() {
  if (thread_.joinable()) thread_.join();
}

void LiveTrajectory::Run() {
  session::LowerPriority();  // The first image comes before it.
  auto aligned = Align();
  const std::lock_guard lock(mutex_);
  if (!aligned) {
    news_ =
        fmt::format("warning: {}. The marker alone places the objects.", aligned.error().Message());
    return;
  }
  const session::TrajectorySummary& summary = aligned->summary;
  const std::string clock = ClockText(summary);
  news_ = fmt::format("{}The trajectory {} is aligned; it has the pose of {} of {} frames{}{}.",
                      HasAssumedOffset(summary) ? "warning: " : "", summary.file,
                      summary.frames.by_trajectory,
                      summary.frames.by_trajectory + summary.frames.by_marker +
                          summary.frames.filled + summary.frames.missing,
                      clock.empty() ? "" : "; ", clock);
  if (HasAssumedOffset(summary)) {
    *news_ += " If objects sway against the ground when the camera turns, state offset_s.";
  }
  aligned_ = std::make_shared<const Aligned>(*std::move(aligned));
}

Result<LiveTrajectory::Aligned> LiveTrajectory::Align() {
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, open_());
  recording.frames = std::make_unique<SpreadFrames>(std::move(recording.frames), kMaxSample);
  const CameraModel camera = recording.camera;
  // Nothing is drawn here.
  scene::SceneDescription markers_only = scene_;
  markers_only.objects.clear();
  markers_only.phantoms.clear();
  PLEINAIR_ASSIGN_OR_RETURN(const auto pipeline, session::Pipeline::Create(camera, markers_only));
  bool is_first = true;
  const auto take = [&](const devices::Frame& frame, const session::TrackedFrame&) -> Result<void> {
    if (std::exchange(is_first, false)) request_.clock_start_ns = ClockStartOf(frame);
    return {};
  };
  const session::PassMonitor monitor{
      [this](std::int64_t, std::optional<std::int64_t>) -> Result<void> {
        const std::lock_guard lock(mutex_);
        if (stop_ || InterruptGuard::Interrupted())
          return SystemError(request_.trajectory.file, "was not aligned before the end");
        return {};
      },
      nullptr};
  PLEINAIR_RETURN_IF_ERROR(session::TrackRecording(*pipeline, std::move(recording), take, monitor));
  PLEINAIR_ASSIGN_OR_RETURN(request_.more_views,
                            ViewsNearSample(*pipeline, request_, open_, monitor));
  PLEINAIR_RETURN_IF_ERROR(pipeline->FollowTrajectory(request_));
  return Aligned{camera, *pipeline->PathMarker(), *pipeline->trajectory_summary()};
}

void LiveTrajectory::Played(std::int64_t index, const session::FrameTime& recorded) {
  const std::lock_guard lock(mutex_);
  played_.push_back({index, recorded});
  if (played_.size() > kRememberedFrames) played_.pop_front();
}

session::FrameTime LiveTrajectory::RecordedTimeOf(const devices::Frame& frame) const {
  const auto found = std::find_if(played_.rbegin(), played_.rend(), [&](const PlayedFrame& played) {
    return played.index == frame.index;
  });
  if (found != played_.rend()) return found->recorded;
  return {frame.index, frame.timestamp_ns};
}

std::optional<session::CameraPose> LiveTrajectory::PoseIn(
    const devices::Frame& frame, const std::optional<session::CameraPose>& by_marker) {
  std::shared_ptr<const Aligned> aligned;
  session::FrameTime recorded;
  {
    const std::lock_guard lock(mutex_);
    aligned = aligned_;
    recorded = RecordedTimeOf(frame);
  }
  if (!aligned) return by_marker;
  const auto pose = session::PoseIn(request_.trajectory, recorded.frame_index,
                                    recorded.timestamp_ns, aligned->summary.offset.offset_ns);
  if (!pose) return by_marker;
  const bool is_seen = by_marker && session::ShowsReferenceMarker(by_marker->observation);
  session::Observation observation = session::ObservationByTrajectory(
      aligned->camera, scene_.marker.size_m, {frame.index, frame.timestamp_ns},
      is_seen ? &by_marker->observation : nullptr, aligned->summary.alignment, *pose);
  session::CameraPose followed{by_marker ? by_marker->marker : aligned->marker,
                               std::move(observation)};
  if (by_marker) {
    followed.motion = session::MovedTo(by_marker->motion, followed.observation.camera_from_marker);
    followed.exposure_s = by_marker->exposure_s;
  }
  return followed;
}

std::optional<std::string> LiveTrajectory::TakeNews() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, std::nullopt);
}

}  // namespace pleinair::app
