#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/live/live_session.h"
#include "app/live/scene_file.h"
#include "base/error.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"

namespace pleinair::devices {
class LiveCamera;
}

namespace pleinair::app {

struct LiveWindowOptions {
  CameraModel camera;
  scene::SceneDescription scene;
  compositor::ComposerOptions drawing;
  double convergence = session::SceneEdit{}.convergence;  ///< Initial value of the session.
  devices::LiveCamera* live_camera = nullptr;             ///< Null for a recording.
  std::optional<double> seconds;                          ///< Maximum duration.
  int width = 0, height = 0;                ///< Size of the window; 0: fits the screen.
  double ui_scale = 0.0;                    ///< Font scale; 0: the screen's scale.
  std::filesystem::path screenshots = ".";  ///< Folder of screenshots and recordings.
  SceneFile* scene_file = nullptr;          ///< Where "save scene" writes; null: nowhere.
  /// Reports the camera events since the last call; returns the last one as text.
  std::function<std::string()> poll_camera;
};

/// Shows a session in a window (GLFW, Dear ImGui) until it is closed or the recording ends. Frames
/// are drawn on another thread with its own context. The window responds quickly even if frames are
/// slow, and frames do not wait for the window. Errors: no display, no OpenGL 3.3, those of the
/// session.
Result<void> ShowInWindow(LiveSession& session, const LiveWindowOptions& options);

}  // namespace pleinair::app
