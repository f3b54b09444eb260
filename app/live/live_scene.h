#pragma once

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
#include "session/light_options.h"
#include "session/scene_edit.h"
#include "session/scene_renderer.h"

namespace pleinair::app {

/// The scene of a live session as it is edited meanwhile, and the light that is made for it beside
/// the frames.
class LiveScene {
 public:
  LiveScene(const scene::SceneDescription& described, const compositor::ComposerOptions& drawing,
            const session::LightOptions& light)
      : described_(described),
        edit_(session::UneditedScene(described, drawing, light.convergence)) {}

  /// Makes the first light, at `start`, gives it to the renderer, and goes on with the next.
  /// Errors: the geometry.
  Result<void> StartLight(const CameraModel& camera, const session::LightOptions& light,
                          UtcTime start, session::SceneRenderer* renderer);

  /// Changes the scene from the next frame on; its light follows when it is made. Any thread.
  void Edit(const session::SceneEdit& edit);

  /// The description with the last edit. Any thread.
  scene::SceneDescription Edited() const;

  /// Reflectances of the marker that serves as the light meter.
  void SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance);

  /// Gives the renderer the edits since the last frame, and the light made since, for a frame of
  /// `moment`.
  Result<void> Update(UtcTime moment, session::SceneRenderer* renderer);

  /// Offers a frame to measure the light in.
  void Show(const std::shared_ptr<const devices::Frame>& frame,
            const Transform<Camera, Marker>& camera_from_marker, UtcTime moment);

  /// Notes how long composing a frame took and how soon the next one comes, so that drawing keeps
  /// up with the camera.
  void NoteDrawn(double compose_ms, double period_ms);

  /// The detail in use if it is chosen automatically. Any thread.
  session::Detail detail() const;
  /// Progress of the light; nothing if none is computed here. Any thread.
  std::optional<session::BackgroundLight::Progress> light_progress() const;

  void Stop();

 private:
  const scene::SceneDescription described_;
  std::unique_ptr<session::BackgroundLight> light_;
  mutable std::mutex mutex_;
  session::SceneEdit edit_;
  bool edited_ = false;
  LiveDetail detail_;
};

}  // namespace pleinair::app
