#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "devices/cameras/live_camera.h"

namespace pleinair::vm {

// What the tests of cameras on real drivers share.

constexpr std::chrono::milliseconds kLong{20000};  ///< Only ever waited out by a failing test.
constexpr const char* kUsb = "v4l2:serial=0001";   ///< The simulator's camera.

std::int64_t Now_ns();

devices::LiveCameraOptions Options(const std::string& uri, devices::PixelFormat format, int width,
                                   int height, double rate_hz = 30.0);

/// Null where it cannot be opened.
std::unique_ptr<devices::LiveCamera> Open(const devices::LiveCameraOptions& options);

/// Takes frames, as an application does, until an event of this kind comes; gives it.
std::optional<devices::CameraEvent> WaitFor(devices::LiveCamera* camera,
                                            devices::CameraEvent::Kind kind);

/// How a camera was pulled out and came back.
struct Replug {
  bool gone = false, back = false;
  std::int64_t reported_after_ns =
      0;  ///< From the last frame before it was gone to the word of it.
};

/// Takes frames until a camera is gone and connected again, from the start: every event counts.
Replug WatchReplug(devices::LiveCamera* camera);

/// What was lost while so many frames came.
devices::FrameLoss Collect(devices::LiveCamera* camera, int frames);

/// The node of vivid, which is there from the start.
std::string VividNode();

/// Sets a control of vivid's by its name, through a file of our own: it is the test, not the
/// camera, that wants it.
void SetByName(const std::string& node, const char* name, int value);

}  // namespace pleinair::vm
