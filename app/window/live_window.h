#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/live/live_session.h"
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
  double convergence = session::SceneEdit{}.convergence;  ///< The session's at first.
  devices::LiveCamera* live_camera = nullptr;             ///< Null for a recording.
  std::optional<double> seconds;                          ///< Ends after so long.
  int width = 0, height = 0;                ///< Of the window; 0: what suits the screen.
  double ui_scale = 0.0;                    ///< Of the letters; 0: what the screen asks for.
  std::filesystem::path screenshots = ".";  ///< Where screenshots and recordings go.
  /// Tells what the camera has reported since; gives the last thing in words for people.
  std::function<std::string()> poll_camera;
};

/// Shows a session in a window (GLFW, Dear ImGui) until it is closed or the recording ends. Frames
/// are drawn on a thread of their own with a context of their own: the window stays quick however
/// slow they are, and they do not wait for it. Errors: no display, no OpenGL 3.3, the session's.
Result<void> ShowInWindow(LiveSession& session, const LiveWindowOptions& options);

}  // namespace pleinair::app
