#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/camera_model.h"
#include "base/camera_response.h"
#include "base/frames.h"
#include "compositor/photometry/changes/light_probes.h"
#include "devices/frame.h"
#include "scene/marker_reflectance.h"
#include "session/following/forward_follower.h"
#include "session/following/shown_frame.h"
#include "session/light_follower.h"

namespace pleinair::session {

/// Follows sun and sky of a live session (ForwardFollower) on two threads, so that no frame waits
/// for it. One estimates the light of the newest frame. The other, of low priority, traces the
/// light on new probes. A frame is drawn with its own light, or with that of the last frame before
/// it whose light is known.
class LiveLight {
 public:
  /// `camera`: the lens of the frames.
  LiveLight(const CameraModel& camera, const CameraResponse& response);
  ~LiveLight();

  /// Sets the light to which the factors refer. Until the first call nothing is followed.
  void Use(const LightReference& reference);

  /// Offers the next frame and returns at once. A frame that still waits is replaced.
  void Show(std::shared_ptr<const devices::Frame> frame,
            const Transform<Camera, Marker>& camera_from_marker,
            const scene::MarkerReflectance& marker);

  /// Light of a frame, or of the last followed frame before it. The last hundred followed frames
  /// are kept; for a frame before all of them, the reference light.
  FollowedLight Of(std::int64_t frame_index) const;

  /// State of the newest frame that was followed.
  struct Newest {
    bool in_full_sun = true;  ///< See ForwardFollower::IsInFullSun().
    std::int64_t frames = 0;  ///< Frames followed so far.
  };
  Newest newest() const;

  /// Ends the threads. Nothing is followed afterwards.
  void Stop();

 private:
  struct Lights {
    std::int64_t reference = 0;
    std::vector<compositor::ProbeLight> lights;
  };
  /// State that the threads and their callers share.
  struct Shared {
    bool stop = false;
    std::vector<LightReference> references{};
    std::optional<ShownFrame> shown{};
    std::optional<ProbesToLight> to_light{};
    bool lighting = false;  // Probes are being lit, or their light waits to be taken.
    std::optional<Lights> lit{};
    std::map<std::int64_t, FollowedLight> lights{};  // By frame.
    Newest newest{};
  };

  void Follow();
  void TraceLights();

  ForwardFollower follower_;  // Used by Follow() alone.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Shared shared_;  // Protected by the mutex.
  std::vector<std::thread> threads_;
};

}  // namespace pleinair::session
