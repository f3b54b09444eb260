#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "app/live/live_detail.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/utc_time.h"
#include "compositor/composer_options.h"
#include "devices/frame.h"
#include "scene/marker_reflectance.h"
#include "scene/scene_description.h"
#include "session/background_light.h"
#include "session/baked_lighting.h"
#include "session/following/live_lens.h"
#include "session/following/live_light.h"
#include "session/light_follower.h"
#include "session/light_options.h"
#include "session/scene_edit.h"
#include "session/scene_renderer.h"

namespace pleinair::app {

/// The scene of a live session with its edits, and the light computed for it in the background.
class LiveScene {
 public:
  LiveScene(const scene::SceneDescription& described, const compositor::ComposerOptions& drawing,
            const session::LightOptions& light)
      : described_(described),
        edit_(session::UneditedScene(described, drawing, light.convergence)) {}

  /// Begins to follow sun and sky by the frames of Follow(), unless `light` holds them. Begins to
  /// measure what is not stated of lens and exposure. `camera`: the lens of the frames. Call it
  /// before the frames are tracked.
  void StartFollowing(const CameraModel& camera, const session::LightOptions& light,
                      const session::SceneRenderer& renderer);

  /// Offers a tracked frame, to follow its light and its lens. May run on another thread than the
  /// rest.
  void Follow(const std::shared_ptr<const devices::Frame>& frame,
              const Transform<Camera, Marker>& camera_from_marker,
              const scene::MarkerReflectance& marker);

  /// How the light of a frame differs from that in use (session::LiveLight::Of()).
  session::FollowedLight FollowedIn(std::int64_t frame_index) const;

  /// Computes the first light at `start`, passes it to the renderer, and continues in the
  /// background. Errors: the geometry.
  Result<void> StartLight(const CameraModel& camera, const session::LightOptions& light,
                          UtcTime start, session::SceneRenderer* renderer);

  /// Changes the scene from the next frame on. Its light follows when it is computed. Thread-safe.
  void Edit(const session::SceneEdit& edit);

  /// The description with the last edit. Thread-safe.
  scene::SceneDescription Edited() const;

  /// Sets the reflectances of the marker that the exposure is estimated from.
  void SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance);

  /// Passes the edits, the light and the lens since the last frame to the renderer, for a frame at
  /// `moment`.
  Result<void> Update(UtcTime moment, session::SceneRenderer* renderer);

  /// Offers a frame to the light estimator.
  void Show(const std::shared_ptr<const devices::Frame>& frame,
            const Transform<Camera, Marker>& camera_from_marker, UtcTime moment);

  /// Reports the composition time of a frame and the frame period, so that the detail can follow
  /// the camera's rate.
  void NoteDrawn(double compose_ms, double period_ms);

  /// The level in use if the detail is chosen automatically. Thread-safe.
  session::Detail detail() const;
  /// Progress of the light computation; nothing if there is none here. Thread-safe.
  std::optional<session::BackgroundLight::Progress> light_progress() const;

  void Stop();

 private:
  Result<void> Take(std::shared_ptr<const session::BakedLighting> light,
                    session::SceneRenderer* renderer);
  /// True if the scene is drawn in the light of another time or place than the frames'.
  bool ShowsOtherMoment() const;

  const scene::SceneDescription described_;
  std::unique_ptr<session::BackgroundLight> light_;
  std::unique_ptr<session::LiveLight> changes_;             // Null: light is not followed.
  std::unique_ptr<session::LiveLens> lens_;                 // Null: nothing of it is measured.
  std::shared_ptr<const session::BakedLighting> followed_;  // To which the changes refer.
  mutable std::mutex mutex_;
  session::SceneEdit edit_;
  bool edited_ = false;
  LiveDetail detail_;
};

}  // namespace pleinair::app
