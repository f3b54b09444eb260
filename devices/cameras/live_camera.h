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

/// Something that happened to a camera, told once.
struct CameraEvent {
  enum class Kind {
    kConnected,  ///< Opened, first or again; `words`: each difference between asked and got.
    kGone,       ///< Unplugged, switched off, or its stream broke.
    kWaiting,    ///< Not there or not usable; `words` say why. It is tried again and again.
    kStalled,    ///< It is there but sends nothing.
    kRecovered,  ///< It sends again after a stall.
  };
  Kind kind = Kind::kConnected;
  std::int64_t time_ns = 0;  ///< Steady clock.
  std::string details;
};

struct LiveCameraOptions {
  CameraUri uri;
  FormatRequest pictures;
  std::vector<ControlRequest> controls;  ///< Held each time the camera is opened.
  bool wait_for_camera = true;           ///< Else Open() fails where it is not there.
  /// A camera that sends nothing for so long has stalled; after as long again it is opened anew.
  std::chrono::milliseconds stall_limit{1500};
};

/// A camera that is plugged in, pulled out and plugged in again. A thread of its own empties the
/// driver and keeps the newest image only, so a slow consumer neither starves the driver nor
/// gets old pictures; what it missed is counted. Damaged pictures are counted and never delivered.
class LiveCamera : public FrameSource {
 public:
  /// Errors: the backend is not in this build; and, unless it is to be waited for, whatever keeps
  /// the camera from streaming.
  static Result<std::unique_ptr<LiveCamera>> Open(LiveCameraOptions options);

  /// The same with another way to open a device: tests.
  using Opener =
      std::function<Result<std::unique_ptr<CameraDevice>>(const CameraUri&, const FormatRequest&)>;
  static Result<std::unique_ptr<LiveCamera>> OpenWith(LiveCameraOptions options, Opener opener);

  ~LiveCamera() override;

  /// Waits for a frame newer than the last one, through stalls and replugs. Nothing after Stop().
  Result<std::optional<Frame>> Next() override;

  /// The same, but nothing also when `limit` is over.
  std::optional<Frame> NextWithin(std::chrono::milliseconds limit);

  std::optional<std::int64_t> FrameCount() const override { return std::nullopt; }

  /// Ends waiting and capturing, from any thread; returns at once. The destructor waits for the
  /// device to close.
  void Stop();
  bool stopped() const;

  /// Changes what is held, now and after each replug; the answers come with Answers().
  void LockControls(std::vector<ControlRequest> controls);

  std::vector<CameraEvent> TakeEvents();
  CameraCounts counts() const;
  std::optional<TransportCounts> transport() const;
  /// Of the device that is open now, or was last.
  std::optional<NegotiatedFormat> negotiated() const;
  std::vector<ControlResult> ControlResults() const;

 private:
  class Worker;
  explicit LiveCamera(std::unique_ptr<Worker> worker);

  std::unique_ptr<Worker> worker_;
};

}  // namespace pleinair::devices
