#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "devices/cameras/live_camera.h"

namespace pleinair::vm {

// Helpers of the tests of cameras on real drivers.

constexpr std::chrono::milliseconds kLong{20000};  ///< Reached only by a failing test.
constexpr const char* kUsb = "v4l2:serial=0001";   ///< The simulator's camera.

std::int64_t Now_ns();

devices::LiveCameraOptions Options(const std::string& uri, devices::PixelFormat format, int width,
                                   int height, double rate_hz = 30.0);

/// Null if it cannot be opened.
std::unique_ptr<devices::LiveCamera> Open(const devices::LiveCameraOptions& options);

/// Takes frames, as an application does, until an event of this kind, and returns it.
std::optional<devices::CameraEvent> WaitFor(devices::LiveCamera* camera,
                                            devices::CameraEvent::Kind kind);

/// Result of unplugging and replugging a camera.
struct Replug {
  bool gone = false, back = false;
  std::int64_t reported_after_ns =
      0;  ///< From the last frame before it was gone to the word of it.
};

/// Takes frames until a camera is disconnected and connected again. Every event from the start
/// counts.
Replug WatchReplug(devices::LiveCamera* camera);

/// Losses while this number of frames was taken.
devices::FrameLoss Collect(devices::LiveCamera* camera, int frames);

/// The device node of vivid, which always exists.
std::string VividNode();

/// Sets a control of vivid's by its name, through a file of our own: it is the test, not the
/// camera, that wants it.
void SetByName(const std::string& node, const char* name, int value);

}  // namespace pleinair::vm
