#include "tests/vm/camera_helpers.h"

namespace pleinair::vm {

using devices::CameraEvent;
using devices::LiveCamera;
using devices::LiveCameraOptions;
using Clock = std::chrono::steady_clock;

std::int64_t Now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

LiveCameraOptions Options(const std::string& uri, devices::PixelFormat format, int width,
                          int height, double rate_hz) {
  LiveCameraOptions options;
  options.uri = *devices::ParseCameraUri(uri);
  options.pictures = {format, ImageSize{width, height}, rate_hz};
  return options;
}

std::unique_ptr<LiveCamera> Open(const LiveCameraOptions& options) {
  auto camera = LiveCamera::Open(options);
  return camera ? *std::move(camera) : nullptr;
}

std::optional<CameraEvent> WaitFor(LiveCamera* camera, CameraEvent::Kind kind) {
  for (const auto end = Clock::now() + kLong; Clock::now() < end;) {
    for (const CameraEvent& event : camera->TakeEvents()) {
      if (event.kind == kind) return event;
    }
    camera->NextWithin(std::chrono::milliseconds(10));
  }
  return std::nullopt;
}

Replug WatchReplug(LiveCamera* camera) {
  Replug replug;
  std::int64_t last_frame_ns = Now_ns();
  for (const auto end = Clock::now() + 2 * kLong; Clock::now() < end && !replug.back;) {
    const auto frame = camera->NextWithin(std::chrono::milliseconds(10));
    if (frame && !replug.gone) last_frame_ns = *frame->arrival_ns;
    for (const CameraEvent& event : camera->TakeEvents()) {
      replug.back = replug.gone && event.kind == CameraEvent::Kind::kConnected;
      if (event.kind != CameraEvent::Kind::kGone) continue;
      replug.gone = true;
      replug.reported_after_ns = event.time_ns - last_frame_ns;
    }
  }
  return replug;
}

devices::FrameLoss Collect(LiveCamera* camera, int frames) {
  devices::FrameLoss loss;
  for (int i = 0; i < frames; ++i) {
    const auto frame = camera->NextWithin(kLong);
    if (!frame) break;
    loss += frame->loss;
  }
  return loss;
}

}  // namespace pleinair::vm
