#include "app/replay/track_recording.h"

#include <fmt/format.h>

#include <future>
#include <utility>

#include "app/output/detections_writer.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/progress_bar.h"
#include "base/parallel_for.h"
#include "session/marker_refiner.h"

namespace pleinair::app {
namespace {

// Frames whose prints are measured at once: enough for all processors, few enough for memory.
constexpr std::size_t kMeasuredTogether = 8;

/// A frame between finding markers and measuring them.
struct TrackedFrame {
  devices::Frame frame;
  tracker::UnmeasuredMarkers markers;
  std::vector<tracker::LostMarker> lost;
};

/// A frame's moment must be one that UtcTime reaches; some videos' stamps run for centuries.
Result<void> CheckMoment(const TrackRecordingOptions& search, const devices::Frame& frame) {
  std::int64_t moment_ns = 0;
  if (!__builtin_add_overflow(search.scene.place_time.start.nanoseconds_since_1970(),
                              frame.timestamp_ns, &moment_ns)) {
    return {};
  }
  return InputError(search.recording,
                    fmt::format("frame {} lies beyond the years 1678 to 2261", frame.index),
                    "mend the scene's time, or the recording's frame rate or time stamps");
}

/// Measures tracked frames and keeps what is found.
Result<void> TakeTracked(const TrackRecordingOptions& search, std::vector<TrackedFrame> tracked,
                         tracker::Tracker& tracker, session::MarkerRefiner& measurer,
                         DetectionsWriter& detections, StageTimes* times, RecordingTracks* found) {
  std::vector<session::MarkerRefiner::Seen> seen;
  seen.reserve(tracked.size());
  StageTimes together;
  together.Measure("measure", [&] {
    ParallelFor(tracked.size(), 0, [&](std::size_t i) {
      tracker.Align(tracked[i].frame.grey.view(), &tracked[i].markers);
    });
    for (TrackedFrame& frame : tracked) {
      const ImageView<const std::uint8_t> grey = frame.frame.grey.view();
      seen.push_back({grey, tracker.Conclude(grey, std::move(frame.markers))});
    }
    measurer.Measure(seen);
    return 0;
  });
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    const devices::Frame& frame = tracked[i].frame;
    times->Add("measure", together.Summarize()[0].total_ms / static_cast<double>(tracked.size()));
    found->marker_tracks.AddFrame(frame.index, frame.timestamp_ns, seen[i].observations);
    std::string line = DetectionsWriter::Line(frame.index, frame.timestamp_ns, seen[i].observations,
                                              tracked[i].lost);
    PLEINAIR_RETURN_IF_ERROR(detections.Add(line));
    if (search.keep_messages) found->messages.push_back({frame.timestamp_ns, std::move(line)});
  }
  return {};
}

}  // namespace

Result<RecordingTracks> TrackRecording(const TrackRecordingOptions& search,
                                       devices::Recording recording, tracker::Tracker& tracker,
                                       StageTimes* times) {
  PLEINAIR_ASSIGN_OR_RETURN(auto detections, DetectionsWriter::Create(search.detections));
  RecordingTracks found{.marker_tracks = session::MarkerTracks(search.scene.marker)};
  session::MarkerRefiner measurer(recording.camera, search.scene.marker.size_m);
  session::FramePrefetcher frames(std::move(recording.frames));
  ProgressBar bar("Finding markers", frames.FrameCount());
  std::vector<TrackedFrame> tracked;
  StageTimes measuring_times;  // Of the thread that measures, as long as it does.
  // Measuring takes all processors, finding one: while some frames are measured the next are
  // searched. It has the session and the messages of what is found to itself. Last: it uses the
  // others.
  std::future<Result<void>> measuring;
  const auto finish_measuring = [&]() -> Result<void> {
    return measuring.valid() ? measuring.get() : Result<void>();
  };
  for (bool more = true; more;) {
    PLEINAIR_ASSIGN_OR_RETURN(std::optional<devices::Frame> frame,
                              NextFrame(search.recording, frames));
    more = frame.has_value();
    if (more) {
      PLEINAIR_RETURN_IF_ERROR(CheckMoment(search, *frame));
      PLEINAIR_ASSIGN_OR_RETURN(
          auto markers, times->Measure("track", [&] { return tracker.Find(frame->grey.view()); }));
      found.warnings.Add(frame->index, tracker.Warnings());
      found.lost_frames += frame->lost_before;
      tracked.push_back({*std::move(frame), std::move(markers), tracker.Lost()});
    }
    if (more && tracked.size() < kMeasuredTogether) continue;
    PLEINAIR_RETURN_IF_ERROR(finish_measuring());
    for (std::size_t i = 0; i < tracked.size(); ++i) bar.Advance();
    measuring =
        std::async(std::launch::async, [&, together = std::exchange(tracked, {})]() mutable {
          return TakeTracked(search, std::move(together), tracker, measurer, detections,
                             &measuring_times, &found);
        });
  }
  PLEINAIR_RETURN_IF_ERROR(finish_measuring());
  times->Add(measuring_times);
  times->Add(frames.Finish());
  PLEINAIR_RETURN_IF_ERROR(detections.Finish());
  if (found.marker_tracks.frames() == 0) {
    return InputError(search.recording, "holds no frames", "record it again");
  }
  return found;
}

Result<std::optional<devices::Frame>> NextFrame(const std::string& recording,
                                                session::FramePrefetcher& frames) {
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(recording));
  return frames.Next();
}

}  // namespace pleinair::app
