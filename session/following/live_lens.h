#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "compositor/lens/focus_fit.h"
#include "compositor/picture/side_profile.h"
#include "devices/frame.h"
#include "scene/marker_reflectance.h"
#include "session/following/shown_frame.h"
#include "session/lens_measurement.h"

namespace pleinair::session {

/// Measures focus, aperture and exposure of a live session on the marker, as MeasureLens() does for
/// a recording, by the frames so far. A thread of low priority reads five frames a second. It
/// fits those of the last 20 s every 2 s. No frame waits for it.
class LiveLens {
 public:
  /// `camera`: the lens of the frames. `known`: what is stated.
  LiveLens(const CameraModel& camera, const CameraResponse& response,
           const compositor::KnownLens& known);
  ~LiveLens();

  /// Offers the next frame that shows the marker, and returns at once. A frame is read when the
  /// next one shows how it moved.
  void Show(std::shared_ptr<const devices::Frame> frame,
            const Transform<Camera, Marker>& camera_from_marker,
            const scene::MarkerReflectance& marker);

  /// What the last fit measured, once. Thread-safe.
  std::optional<MeasuredLens> TakeNews();

  /// Ends the thread. Nothing is measured afterwards.
  void Stop();

 private:
  /// A frame to be read, and the poses around it.
  struct Job {
    ShownFrame shown;
    std::optional<compositor::MarkerMotion> motion;
  };
  /// State that the thread and its callers share.
  struct Shared {
    bool stop = false;
    std::deque<ShownFrame> shown{};  // The last three.
    std::optional<Job> job{};
    std::optional<MeasuredLens> news{};
    double interval_s = 0.0;  // The shortest between two frames.
  };

  void Run();
  void Read(const Job& job);
  MeasuredLens Fit(double interval_s) const;

  const CameraModel camera_;
  const CameraResponse response_;
  const compositor::KnownLens known_;
  std::vector<compositor::SideProfile> profiles_;  // Used by Run() alone.
  std::mutex mutex_;
  std::condition_variable changed_;
  Shared shared_;  // Protected by the mutex.
  std::thread thread_;
};

}  // namespace pleinair::session
