#include "app/window/window_state.h"

#include <cmath>

namespace pleinair::app {
namespace {

constexpr double kStep_m = 0.05, kFineStep_m = 0.005;
constexpr double kTurn_deg = 5.0, kFineTurn_deg = 0.5;
constexpr double kGrowth = 1.05, kFineGrowth = 1.005;
constexpr double kTimeStep_s = 600.0, kFineTimeStep_s = 60.0;
constexpr double kDay_s = 86400.0;

/// Steps suit objects of about one metre; others move in proportion to their size.
double SizeOf(const ObjectBox& box, const session::ObjectPlace& place) {
  return Norm(box.max - box.min) * place.scale;
}

void DoToObject(Action action, bool fine, WindowState* state) {
  const auto index = static_cast<std::size_t>(state->selected);
  if (index >= state->edit.objects.size()) return;
  session::ObjectPlace& place = state->edit.objects[index];
  const ObjectBox& box = state->boxes[index];
  const Vec3 up = UpOf(state->scene.marker);
  const ViewerAxes axes = state->frame.camera_from_marker
                              ? AxesOf(*state->frame.camera_from_marker, up)
                              : ViewerAxes{{1, 0, 0}, Cross(up, {1, 0, 0})};
  const double step = (fine ? kFineStep_m : kStep_m) * std::max(SizeOf(box, place), 1e-3);
  const double turn = fine ? kFineTurn_deg : kTurn_deg;
  const double growth = fine ? kFineGrowth : kGrowth;
  const auto move = [&](Vec3 direction) {
    place.translation_m = place.translation_m + direction * step;
  };
  switch (action) {
    case Action::kMoveLeft:
      return move(-axes.right);
    case Action::kMoveRight:
      return move(axes.right);
    case Action::kMoveAway:
      return move(axes.away);
    case Action::kMoveNearer:
      return move(-axes.away);
    case Action::kRaise:
      return move(up);
    case Action::kLower:
      return move(-up);
    case Action::kTurnLeft:
      place = Turned(box, place, turn, up);
      return;
    case Action::kTurnRight:
      place = Turned(box, place, -turn, up);
      return;
    case Action::kGrow:
      place = Scaled(box, place, growth, up);
      return;
    case Action::kShrink:
      place = Scaled(box, place, 1.0 / growth, up);
      return;
    case Action::kResetObject:
      place = state->unedited.objects[index];
      return;
    default:
      return;
  }
}

void ResetSurface(WindowState* state) {
  const auto index = static_cast<std::size_t>(state->selected_surface);
  if (index < state->edit.phantoms.size()) {
    state->edit.phantoms[index] = state->unedited.phantoms[index];
  }
}

}  // namespace

scene::MarkerDescription WindowState::marker() const {
  scene::MarkerDescription in_use = scene.marker;
  in_use.heading = FromDegrees(edit.heading_deg.value_or(
      frame.is_there && status.statistics.frames.drawn > 0 ? status.statistics.light.heading_deg
                                                           : ToDegrees(scene.marker.heading)));
  return in_use;
}

WindowState WindowState::For(const scene::SceneDescription& scene,
                             const compositor::ComposerOptions& drawing, double convergence) {
  WindowState state;
  state.scene = scene;
  state.edit = state.unedited = session::UneditedScene(scene, drawing, convergence);
  state.frame.moment = scene.place_time.start;
  if (state.edit.objects.size() == 1) state.selected = 0;
  state.overlays.pole.height_m = scene.marker.size_m;
  return state;
}

void SetShownTime(UtcTime time, WindowState* state) {
  state->edit.later_s = static_cast<double>(time.nanoseconds_since_1970() -
                                            state->frame.moment.nanoseconds_since_1970()) *
                        1e-9;
}

double TimeOfDay(UtcTime time, double utc_offset_s) {
  const double local = static_cast<double>(time.nanoseconds_since_1970()) * 1e-9 + utc_offset_s;
  return local - kDay_s * std::floor(local / kDay_s);
}

void SetTimeOfDay(double seconds, double utc_offset_s, WindowState* state) {
  state->edit.later_s += seconds - TimeOfDay(state->shown_time(), utc_offset_s);
}

void Do(Action action, bool fine, UtcTime now, WindowState* state) {
  const double time_step = fine ? kFineTimeStep_s : kTimeStep_s;
  switch (action) {
    case Action::kHelp:
      state->overlays.help = !state->overlays.help;
      return;
    case Action::kPanel:
      state->overlays.panel = !state->overlays.panel;
      return;
    case Action::kClose:
      state->requests.close = true;
      return;
    case Action::kSaveScene:
      state->requests.save_scene = true;
      return;
    case Action::kScreenshot:
      state->requests.screenshot = true;
      return;
    case Action::kRecord:
      state->requests.recording_change = true;
      return;
    case Action::kNow:
      SetShownTime(now, state);
      return;
    case Action::kAsRecorded:
      state->edit.later_s = 0.0;
      return;
    case Action::kEarlier:
      state->edit.later_s -= time_step;
      return;
    case Action::kLater:
      state->edit.later_s += time_step;
      return;
    case Action::kSurfaces:
      state->overlays.moving_surfaces = !state->overlays.moving_surfaces;
      return;
    case Action::kNextObject: {
      const int count = static_cast<int>(state->edit.objects.size());
      state->selected = count == 0 ? -1 : (state->selected + 1) % count;
      return;
    }
    case Action::kDeselect:
      if (state->overlays.help) {
        state->overlays.help = false;
      } else if (state->overlays.turning_north) {
        state->overlays.turning_north = false;
      } else if (state->overlays.moving_surfaces) {
        state->overlays.moving_surfaces = false;
      } else {
        state->selected = -1;
      }
      return;
    case Action::kNorth:
      state->overlays.turning_north = !state->overlays.turning_north;
      return;
    case Action::kShadowMaps:
      state->edit.drawing.show_shadow_maps = !state->edit.drawing.show_shadow_maps;
      return;
    case Action::kLockExposure:
      state->exposure_locked = !state->exposure_locked;
      state->edit.lock_exposure = state->exposure_locked;
      state->requests.exposure_change = true;
      return;
    case Action::kResetObject:
      if (state->overlays.moving_surfaces) return ResetSurface(state);
      if (state->selected >= 0) DoToObject(action, fine, state);
      return;
    default:
      if (state->selected >= 0) DoToObject(action, fine, state);
  }
}

}  // namespace pleinair::app
