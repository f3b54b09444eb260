#pragma once

#include <cstdint>

#include "app/live/latency_meter.h"
#include "devices/frame.h"
#include "session/background_light.h"
#include "session/scene_edit.h"
#include "session/scene_renderer.h"

namespace pleinair::app {

/// What a live session has done since its start.
struct LiveStatistics {
  std::int64_t captured = 0;
  std::int64_t tracked = 0;
  std::int64_t with_pose = 0;
  std::int64_t drawn = 0;
  std::int64_t shown = 0;              ///< Where they are shown elsewhere.
  std::int64_t late_for_tracking = 0;  ///< Replaced by a newer frame before it was tracked.
  std::int64_t late_for_drawing = 0;   ///< Tracked, and replaced before it was drawn.
  std::int64_t late_for_screen = 0;    ///< Drawn, and replaced before it was shown elsewhere.
  /// Counted as they were given up when the session ended; 0 before.
  std::int64_t on_the_way_at_end = 0;
  devices::FrameLoss loss;  ///< Before we got them.
  std::int64_t recorded = 0;
  std::int64_t left_out_of_recording = 0;
  LatencyMeter::Summary latency;  ///< From a frame's stamp until it was drawn, or shown.
  double period_ms = 0.0;         ///< Between frames' stamps.
  double track_ms = 0.0;          ///< Of the last frame.
  session::RenderTimes render;
  double draw_ms = 0.0;
  session::Detail detail = session::Detail::kFine;
  session::BackgroundLight::Progress light;

  /// Frames captured of which nothing else here tells: those on their way while the session runs,
  /// at most five; none when it has ended.
  std::int64_t Unaccounted() const {
    return captured - drawn - late_for_tracking - late_for_drawing - on_the_way_at_end;
  }
};

}  // namespace pleinair::app
