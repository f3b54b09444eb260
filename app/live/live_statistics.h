#pragma once

#include <cstdint>

#include "app/live/latency_meter.h"
#include "app/live/recording_switch.h"
#include "devices/frame.h"
#include "session/background_light.h"
#include "session/render_times.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// Frames of a live session, by the last stage that they passed.
struct FrameCounts {
  std::int64_t captured = 0;
  std::int64_t tracked = 0;
  std::int64_t with_pose = 0;
  std::int64_t drawn = 0;
  std::int64_t shown = 0;  ///< Where another component shows the frames.
};

/// Frames replaced by newer ones.
struct LateFrames {
  std::int64_t for_tracking = 0;  ///< Before tracking.
  std::int64_t for_drawing = 0;   ///< Tracked, not drawn.
  std::int64_t for_screen = 0;    ///< Drawn, not shown.
};

/// Durations of the last frame, in milliseconds, except the period.
struct FrameTiming {
  double period_ms = 0.0;  ///< Running mean of the difference between frame stamps.
  double track_ms = 0.0;
  double draw_ms = 0.0;
  session::RenderTimes render;
};

/// Totals of a live session since its start.
struct LiveStatistics {
  FrameCounts frames;
  LateFrames late;
  /// Frames in the queues when the session ended; 0 before.
  std::int64_t on_the_way_at_end = 0;
  devices::FrameLoss loss;  ///< Before they reached the session.
  RecordingSwitch::Counts recording;
  LatencyMeter::Summary latency;  ///< From a frame's stamp until it was drawn, or shown.
  FrameTiming timing;
  /// From the start of the program's work until the first composed image; 0: there was none.
  double first_image_s = 0.0;
  session::Detail detail = session::Detail::kFine;
  session::BackgroundLight::Progress light;

  /// Captured frames in no other count. While the session runs, these are the frames in the queues,
  /// at most five. After the end there are none.
  std::int64_t Unaccounted() const {
    return frames.captured - frames.drawn - late.for_tracking - late.for_drawing -
           on_the_way_at_end;
  }
};

}  // namespace pleinair::app
