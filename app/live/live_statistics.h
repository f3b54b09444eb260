#pragma once

#include <cstdint>

#include "app/live/latency_meter.h"
#include "app/live/recording_switch.h"
#include "devices/frame.h"
#include "session/background_light.h"
#include "session/render_times.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// Frames of a live session by how far they came.
struct FrameCounts {
  std::int64_t captured = 0;
  std::int64_t tracked = 0;
  std::int64_t with_pose = 0;
  std::int64_t drawn = 0;
  std::int64_t shown = 0;  ///< Where they are shown elsewhere.
};

/// Frames that were replaced by newer ones.
struct LateFrames {
  std::int64_t for_tracking = 0;  ///< Before they were tracked.
  std::int64_t for_drawing = 0;   ///< Tracked, not yet drawn.
  std::int64_t for_screen = 0;    ///< Drawn, not yet shown elsewhere.
};

/// Milliseconds of the last frame, but for the first.
struct FrameTiming {
  double period_ms = 0.0;  ///< Between frames' stamps, a running mean.
  double track_ms = 0.0;
  double draw_ms = 0.0;
  session::RenderTimes render;
};

/// What a live session has done since its start.
struct LiveStatistics {
  FrameCounts frames;
  LateFrames late;
  /// Counted as they were given up when the session ended; 0 before.
  std::int64_t on_the_way_at_end = 0;
  devices::FrameLoss loss;  ///< Before we got them.
  RecordingSwitch::Counts recording;
  LatencyMeter::Summary latency;  ///< From a frame's stamp until it was drawn, or shown.
  FrameTiming timing;
  session::Detail detail = session::Detail::kFine;
  session::BackgroundLight::Progress light;

  /// Frames captured of which nothing else here tells: those on their way while the session runs,
  /// at most five; none when it has ended.
  std::int64_t Unaccounted() const {
    return frames.captured - frames.drawn - late.for_tracking - late.for_drawing -
           on_the_way_at_end;
  }
};

}  // namespace pleinair::app
