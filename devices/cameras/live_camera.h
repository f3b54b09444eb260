#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/cameras/camera.h"
#include "devices/cameras/camera_counts.h"
#include "devices/cameras/camera_uri.h"
#include "devices/frame_source.h"

namespace pleinair::devices {

class CameraDevice;

/// A change in a camera's state, reported once.
struct CameraEvent {
  enum class Kind {
    kConnected,  ///< Opened, first or again; `details`: each difference between request and result.
    kGone,       ///< Unplugged, switched off, or its stream broke.
    kWaiting,    ///< Not found or not usable; `details` gives the reason. Opening is retried.
    kStalled,    ///< Connected, but delivers no frames.
    kRecovered,  ///< Delivers frames again after a stall.
  };
  Kind kind = Kind::kConnected;
  std::int64_t time_ns = 0;  ///< Steady clock.
  std::string details;
};

struct LiveCameraOptions {
  CameraUri uri;
  FormatRequest pictures;
  std::vector<ControlRequest> controls;  ///< Applied each time the camera is opened.
  bool wait_for_camera = true;  ///< If false, Open() fails when the camera is not connected.
  /// A camera without frames for this long is stalled; after the same time again it is reopened.
  std::chrono::milliseconds stall_limit{1500};
};

/// A camera that survives unplugging and replugging. A background thread empties the driver's queue
/// and keeps the newest image only: a slow consumer neither blocks the driver nor gets old images.
/// Skipped frames are counted. Damaged images are counted and never delivered.
class LiveCamera : public FrameSource {
 public:
  /// Errors: the backend is not in this build; if `wait_for_camera` is false, also any reason why
  /// the camera cannot stream.
  static Result<std::unique_ptr<LiveCamera>> Open(LiveCameraOptions options);

  /// As Open(), with another function to open a device; for tests.
  using Opener =
      std::function<Result<std::unique_ptr<CameraDevice>>(const CameraUri&, const FormatRequest&)>;
  static Result<std::unique_ptr<LiveCamera>> OpenWith(LiveCameraOptions options, Opener opener);

  ~LiveCamera() override;

  /// Waits for a frame newer than the last one, through stalls and replugs. Returns nullopt after
  /// Stop().
  Result<std::optional<Frame>> Next() override;

  /// As Next(), but also returns nullopt after `limit`.
  std::optional<Frame> NextWithin(std::chrono::milliseconds limit);

  std::optional<std::int64_t> FrameCount() const override { return std::nullopt; }

  /// Ends waiting and capturing, from any thread; returns at once. The destructor waits until the
  /// device is closed.
  void Stop();
  bool stopped() const;

  /// Changes the locked controls, now and after each replug; Answers() has the results.
  void LockControls(std::vector<ControlRequest> controls);

  std::vector<CameraEvent> TakeEvents();
  CameraCounts counts() const;
  std::optional<TransportCounts> transport() const;
  /// Format of the open device, or of the last one.
  std::optional<NegotiatedFormat> negotiated() const;
  std::vector<ControlResult> ControlResults() const;

 private:
  class Worker;
  explicit LiveCamera(std::unique_ptr<Worker> worker);

  std::unique_ptr<Worker> worker_;
};

}  // namespace pleinair::devices
