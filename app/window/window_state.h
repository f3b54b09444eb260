#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/live/live_session.h"
#include "app/window/north_pole.h"
#include "app/window/object_moves.h"
#include "base/utc_time.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// Overlays on the frame.
struct Overlays {
  bool panel = true, help = false;
  bool turning_north = false;  ///< The virtual pole is shown.
  /// The mouse moves ground, boxes and walls in place of objects, and their outlines are shown.
  bool moving_surfaces = false;
  NorthPole pole;
};

/// The frame on the screen.
struct ShownFrame {
  CameraModel camera;
  std::optional<Transform<Camera, Marker>> camera_from_marker;
  UtcTime moment;  ///< Without SceneEdit::later_s.
  bool is_there = false;
  session::LightSummary light;
};

/// Status of the session.
struct LiveStatus {
  LiveStatistics statistics;
  double shown_per_second = 0.0;  ///< Frame rate.
  bool recording = false;
  std::string camera;  ///< Last report of the camera.
  bool camera_is_away = false;
};

/// Requests of keys and panel, which the window carries out.
struct WindowRequests {
  bool screenshot = false, window_screenshot = false;
  bool save_scene = false;
  bool recording_change = false, exposure_change = false;
  bool close = false;
};

/// State of the window and all that the panel and the keys change. It needs no window, so that
/// tests can press keys.
struct WindowState {
  scene::SceneDescription scene;  ///< As described in its file.
  session::SceneEdit edit, unedited;
  std::vector<ObjectBox> boxes;  ///< Boxes of the scene's objects, in order.
  int selected = -1;             ///< Index of an object; -1: none.
  int selected_surface = -1;     ///< Index of a phantom; -1: none.
  bool exposure_locked = false;
  Overlays overlays;
  ShownFrame frame;
  LiveStatus status;
  WindowRequests requests;
  std::string message;  ///< Last action, for the status line.

  UtcTime shown_time() const { return frame.moment.PlusSeconds(edit.later_s); }
  /// The marker with the heading in use.
  scene::MarkerDescription marker() const;
  /// Initial state for a new session.
  static WindowState For(const scene::SceneDescription& scene,
                         const compositor::ComposerOptions& drawing,
                         double convergence = session::SceneEdit{}.convergence);
};

/// Moves the scene to another time.
void SetShownTime(UtcTime time, WindowState* state);
/// Changes the time within the same local day. `seconds`: since local midnight.
void SetTimeOfDay(double seconds, double utc_offset_s, WindowState* state);
double TimeOfDay(UtcTime time, double utc_offset_s);

/// Actions of keys.
enum class Action {
  kHelp,
  kPanel,
  kClose,
  kSaveScene,
  kScreenshot,
  kRecord,
  kNow,
  kAsRecorded,
  kEarlier,
  kLater,
  kNextObject,
  kDeselect,
  kMoveLeft,
  kMoveRight,
  kMoveAway,
  kMoveNearer,
  kRaise,
  kLower,
  kTurnLeft,
  kTurnRight,
  kGrow,
  kShrink,
  kResetObject,
  kNorth,
  kSurfaces,
  kShadowMaps,
  kLockExposure,
};

/// Executes an action. `fine`: small steps.
void Do(Action action, bool fine, UtcTime now, WindowState* state);

}  // namespace pleinair::app
