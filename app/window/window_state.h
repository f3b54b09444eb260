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

/// What is drawn over the frame.
struct Overlays {
  bool panel = true, help = false;
  bool turning_north = false;  ///< The virtual pole is shown.
  NorthPole pole;
};

/// The frame on the screen.
struct ShownFrame {
  CameraModel camera;
  std::optional<Transform<Camera, Marker>> camera_from_marker;
  UtcTime moment;  ///< Without what the edit adds.
  bool is_there = false;
  session::LightSummary light;
};

/// How the session is doing.
struct LiveStatus {
  LiveStatistics statistics;
  double shown_per_second = 0.0;  ///< Frames.
  bool recording = false;
  std::string camera;  ///< What the camera last reported.
  bool camera_is_away = false;
};

/// What keys and panel asked for, to be done by the window.
struct WindowRequests {
  bool screenshot = false, window_screenshot = false;
  bool recording_change = false, exposure_change = false;
  bool close = false;
};

/// What the window shows and what its user has done: all that the panel and the keys change,
/// without a window, so that tests can press keys, too.
struct WindowState {
  scene::SceneDescription scene;  ///< As it was described.
  session::SceneEdit edit, unedited;
  std::vector<ObjectBox> boxes;  ///< Of the scene's objects, in their order.
  int selected = -1;             ///< Index of an object; -1: none.
  bool exposure_locked = false;
  Overlays overlays;
  ShownFrame frame;
  LiveStatus status;
  WindowRequests requests;
  std::string message;  ///< The last thing done, for the status line.

  UtcTime shown_time() const { return frame.moment.PlusSeconds(edit.later_s); }
  /// The marker with the heading in use.
  scene::MarkerDescription marker() const;
  /// The scene's state for a new session.
  static WindowState For(const scene::SceneDescription& scene,
                         const compositor::ComposerOptions& drawing,
                         double convergence = session::SceneEdit{}.convergence);
};

/// Makes the scene that of another time.
void SetShownTime(UtcTime time, WindowState* state);
/// The time on a local clock's day, seconds since its midnight, to another of the same day.
void SetTimeOfDay(double seconds, double utc_offset_s, WindowState* state);
double TimeOfDay(UtcTime time, double utc_offset_s);

/// What keys do.
enum class Action {
  kHelp,
  kPanel,
  kClose,
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
  kShadowMaps,
  kLockExposure,
};

/// Carries an action out. `fine`: small steps.
void Do(Action action, bool fine, UtcTime now, WindowState* state);

}  // namespace pleinair::app
