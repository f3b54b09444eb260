#include "app/live/live_messages.h"

#include <fmt/format.h>

#include <iostream>

#include <nlohmann/json.hpp>

#include "devices/cameras/live_camera.h"

namespace pleinair::app {
namespace {

const char* Word(devices::CameraEvent::Kind kind) {
  switch (kind) {
    case devices::CameraEvent::Kind::kConnected:
      return "connected";
    case devices::CameraEvent::Kind::kGone:
      return "gone";
    case devices::CameraEvent::Kind::kWaiting:
      return "waiting";
    case devices::CameraEvent::Kind::kStalled:
      return "stalled";
    case devices::CameraEvent::Kind::kRecovered:
      return "recovered";
  }
  return "";
}

nlohmann::json Json(const LatencyMeter::Summary& latency) {
  return {{"median", latency.median_ms}, {"p95", latency.p95_ms}, {"worst", latency.worst_ms}};
}

nlohmann::json Json(const LiveStatistics& s) {
  return {{"captured", s.frames.captured},
          {"tracked", s.frames.tracked},
          {"with_pose", s.frames.with_pose},
          {"drawn", s.frames.drawn},
          {"shown", s.frames.shown},
          {"late_for_tracking", s.late.for_tracking},
          {"late_for_drawing", s.late.for_drawing},
          {"late_for_screen", s.late.for_screen},
          {"on_the_way_at_end", s.on_the_way_at_end},
          {"unaccounted", s.Unaccounted()},
          {"lost",
           {{"by_number", s.loss.by_number},
            {"by_time", s.loss.by_time},
            {"damaged", s.loss.damaged},
            {"not_taken", s.loss.not_taken}}},
          {"recorded", s.recording.recorded},
          {"left_out_of_recording", s.recording.left_out},
          {"first_image_s", s.first_image_s},
          {"latency_ms", Json(s.latency)}};
}

nlohmann::json Json(const LiveInterval& i) {
  return {{"from_s", i.from_s},
          {"to_s", i.to_s},
          {"captured", i.captured},
          {"tracked", i.tracked},
          {"drawn", i.drawn},
          {"late_for_tracking", i.late_for_tracking},
          {"late_for_drawing", i.late_for_drawing},
          {"lost", i.lost},
          {"on_the_way", i.on_the_way},
          {"latency_ms", Json(i.latency)},
          {"memory_mb", i.memory_mb}};
}

}  // namespace

std::string ReportEvents(devices::LiveCamera* camera, bool json) {
  std::string last;
  if (camera == nullptr) return last;
  for (const devices::CameraEvent& event : camera->TakeEvents()) {
    const std::string separator = event.details.empty() ? "" : ": ";
    last = std::string("camera ") + Word(event.kind) + separator + event.details;
    if (json) {
      std::cout << nlohmann::json{{"camera", Word(event.kind)}, {"words", event.details}}.dump(
                       -1, ' ', false, nlohmann::json::error_handler_t::replace)
                << std::endl;
    } else {
      std::cerr << last << '\n';
    }
  }
  return last;
}

std::string ReportNews(LiveTrajectory* trajectory, bool json) {
  const auto news = trajectory == nullptr ? std::nullopt : trajectory->TakeNews();
  if (!news) return "";
  if (json) {
    const nlohmann::json line{{"trajectory", *news}};
    std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
  } else {
    std::cerr << *news << '\n';
  }
  return *news;
}

void ReportControls(const devices::LiveCamera* camera) {
  if (camera == nullptr) return;
  for (const devices::ControlResult& result : camera->ControlResults()) {
    if (!result.details.empty()) std::cerr << "camera: " << result.details << '\n';
  }
}

void Report(const LiveInterval& i, bool json) {
  if (json) {
    std::cout << Json(i).dump() << std::endl;
    return;
  }
  std::cerr << fmt::format(
      "{:.0f} to {:.0f} s: {} frames captured, {} drawn, {} late, {} lost; exposure to picture "
      "{:.0f} ms (95 %: {:.0f}, worst {:.0f}); {:.0f} MB of memory\n",
      i.from_s, i.to_s, i.captured, i.drawn, i.late_for_tracking + i.late_for_drawing, i.lost,
      i.latency.median_ms, i.latency.p95_ms, i.latency.worst_ms, i.memory_mb);
}

void Report(const LiveStatistics& s, bool json) {
  if (json) {
    std::cout << Json(s).dump() << '\n';
    return;
  }
  std::cerr << fmt::format(
      "{} frames captured, {} tracked, {} with a pose, {} drawn; {} late for tracking, {} late for "
      "drawing, {} on their way at the end, {} lost before\n",
      s.frames.captured, s.frames.tracked, s.frames.with_pose, s.frames.drawn, s.late.for_tracking,
      s.late.for_drawing, s.on_the_way_at_end, s.loss.Total());
  if (s.Unaccounted() != 0) std::cerr << s.Unaccounted() << " frames are not accounted for\n";
  if (s.latency.worst_ms > 0.0) {
    std::cerr << fmt::format("exposure to picture: {:.0f} ms (95 %: {:.0f}, worst {:.0f})\n",
                             s.latency.median_ms, s.latency.p95_ms, s.latency.worst_ms);
  }
  if (s.first_image_s > 0.0) {
    std::cerr << fmt::format("first composed image after {:.1f} s\n", s.first_image_s);
  }
  if (s.recording.recorded > 0) {
    std::cerr << fmt::format("{} frames recorded, {} dropped because the disk was too slow\n",
                             s.recording.recorded, s.recording.left_out);
  }
}

}  // namespace pleinair::app
