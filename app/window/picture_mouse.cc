#include "app/window/picture_mouse.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/sun_over_place.h"

namespace pleinair::app {
namespace {

constexpr double kDegreesAcrossAPicture = 270.0;
constexpr double kGrowthANotch = 1.05;
constexpr ImU32 kChosen = IM_COL32(255, 208, 106, 230), kChosenFaint = IM_COL32(255, 208, 106, 90);
constexpr ImU32 kPole = IM_COL32(120, 220, 255, 240), kShadow = IM_COL32(20, 40, 90, 235);

std::optional<ImVec2> OnScreen(const PictureView& view, const WindowState& state, Vec3 in_marker) {
  const Point<Camera> in_camera = *state.frame.camera_from_marker * Point<Marker>{in_marker};
  if (in_camera.xyz.z < 0.01) return std::nullopt;
  const Vec2 screen = view.ScreenFromPixel(ProjectToPixel(state.frame.camera, in_camera));
  return ImVec2(static_cast<float>(screen.x), static_cast<float>(screen.y));
}

void DrawLine(const PictureView& view, const WindowState& state, Vec3 a, Vec3 b, ImU32 color,
              float width) {
  const auto from = OnScreen(view, state, a), to = OnScreen(view, state, b);
  if (from && to) ImGui::GetBackgroundDrawList()->AddLine(*from, *to, color, width);
}

void DrawBox(const PictureView& view, const WindowState& state, int object) {
  const ObjectBox& box = state.boxes[object];
  const session::ObjectPlace& place = state.edit.objects[object];
  constexpr std::array<std::array<int, 2>, 12> kEdges{{{0, 1},
                                                       {2, 3},
                                                       {4, 5},
                                                       {6, 7},
                                                       {0, 2},
                                                       {1, 3},
                                                       {4, 6},
                                                       {5, 7},
                                                       {0, 4},
                                                       {1, 5},
                                                       {2, 6},
                                                       {3, 7}}};
  const Vec3 up = UpOf(state.scene.marker);
  const double foot = Dot(BoxFoot(box, place, up), up);
  for (const auto& [a, b] : kEdges) {
    const Vec3 from = BoxCorner(box, place, a), to = BoxCorner(box, place, b);
    const double size = Norm(to - from) * 0.02 + 1e-6;
    const bool on_foot = Dot(from, up) < foot + size && Dot(to, up) < foot + size;
    DrawLine(view, state, from, to, on_foot ? kChosen : kChosenFaint, on_foot ? 2.0F : 1.0F);
  }
}

/// Outlines of ground, boxes and walls, with a plumb line from the marker to the ground.
void DrawSurfaces(const PictureView& view, const WindowState& state) {
  const scene::SceneDescription scene = session::WithEdit(state.scene, state.edit);
  for (std::size_t i = 0; i < scene.phantoms.size(); ++i) {
    const bool is_chosen = static_cast<int>(i) == state.selected_surface;
    const ImU32 color = is_chosen ? kChosen : kChosenFaint;
    const float width = is_chosen ? 2.0F : 1.0F;
    for (const std::vector<Vec3>& polygon : PlacedPolygons(scene.phantoms[i])) {
      for (std::size_t c = 0; c < polygon.size(); ++c) {
        DrawLine(view, state, polygon[c], polygon[(c + 1) % polygon.size()], color, width);
      }
    }
    const auto& surface = scene.phantoms[i].surface;
    if (!surface || surface->kind != scene::SurfaceKind::kGround) continue;
    const Vec3 foot = UpOf(scene.marker) * -GroundHeight(scene, scene.phantoms[i]);
    DrawLine(view, state, {}, foot, color, width);
  }
}

Vec3 ToSun(const WindowState& state) {
  return scene::SunOver(session::WithEdit(state.scene, state.edit).place_time, state.shown_time())
      .ToSun()
      .xyz;
}

void DrawPole(const PictureView& view, const WindowState& state) {
  const NorthPole& pole = state.overlays.pole;
  const float letter = ImGui::GetFontSize();
  const Vec3 top = pole.foot + UpOf(state.scene.marker) * pole.height_m;
  const auto tip = pole.ShadowTip(state.marker(), ToSun(state));
  if (tip) DrawLine(view, state, pole.foot, *tip, kShadow, letter * 0.25F);
  DrawLine(view, state, pole.foot, top, kPole, letter * 0.2F);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  if (const auto at = OnScreen(view, state, pole.foot)) {
    draw->AddCircleFilled(*at, letter * 0.4F, kPole);
  }
  if (!tip) return;
  if (const auto at = OnScreen(view, state, *tip)) {
    draw->AddCircleFilled(*at, letter * 0.45F, kShadow);
    draw->AddCircle(*at, letter * 0.45F, kPole, 0, 2.0F);
  }
}

bool Near(const std::optional<ImVec2>& point, Vec2 mouse) {
  return point && Norm(Vec2{point->x, point->y} - mouse) < ImGui::GetFontSize();
}

}  // namespace

std::vector<ObjectBox> BoxesOf(const std::vector<compositor::PlacedModel>& placed,
                               const scene::SceneDescription& scene) {
  std::vector<ObjectBox> boxes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const compositor::ModelBounds bounds =
        compositor::BoundsOf(*placed[scene.phantoms.size() + i].model);
    boxes.push_back({scene.objects[i].file.filename().string(), bounds.min_m, bounds.max_m});
  }
  return boxes;
}

void PictureMouse::Update(const PictureView& view, const std::vector<ButtonEvent>& events,
                          WindowState* state) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!state->frame.camera_from_marker) {
    drag_ = Drag::kNone;
    return;
  }
  const Vec2 mouse{static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)};
  for (const ButtonEvent& event : events) {
    if (event.down) {
      Begin(view, event, state);
    } else {
      Continue(view, event.screen, state);
      drag_ = Drag::kNone;
    }
  }
  Continue(view, mouse, state);
  if (io.MouseWheel != 0.0F && !io.WantCaptureMouse && state->selected >= 0) {
    const Sight sight = SightThrough(state->frame.camera, *state->frame.camera_from_marker,
                                     view.PixelFromScreen(mouse));
    if (PickObject(state->boxes, state->edit.objects, sight) == state->selected) {
      session::ObjectPlace& place = state->edit.objects[state->selected];
      place = Scaled(state->boxes[state->selected], place,
                     std::pow(kGrowthANotch, static_cast<double>(io.MouseWheel)),
                     UpOf(state->scene.marker));
    }
  }
  if (state->overlays.moving_surfaces) {
    DrawSurfaces(view, *state);
  } else if (state->selected >= 0 && state->selected < static_cast<int>(state->boxes.size())) {
    DrawBox(view, *state, state->selected);
  }
  if (state->overlays.turning_north) DrawPole(view, *state);
}

void PictureMouse::Begin(const PictureView& view, const ButtonEvent& event, WindowState* state) {
  const bool left = event.button == ButtonEvent::Button::kLeft;
  drag_ = Drag::kNone;
  start_screen_ = event.screen;
  if (state->overlays.turning_north && left) {
    const auto tip = state->overlays.pole.ShadowTip(state->marker(), ToSun(*state));
    if (tip && Near(OnScreen(view, *state, *tip), event.screen)) drag_ = Drag::kPoleTip;
    if (Near(OnScreen(view, *state, state->overlays.pole.foot), event.screen))
      drag_ = Drag::kPoleFoot;
    if (drag_ != Drag::kNone) return;
  }
  start_ = SightThrough(state->frame.camera, *state->frame.camera_from_marker,
                        view.PixelFromScreen(event.screen));
  if (state->overlays.moving_surfaces && left) return BeginSurface(view, event, state);
  const auto picked = PickObject(state->boxes, state->edit.objects, start_);
  state->selected = picked.value_or(-1);
  if (!picked) return;
  start_place_ = state->edit.objects[*picked];
  hold_ = (BoxCorner(state->boxes[*picked], start_place_, 0) +
           BoxCorner(state->boxes[*picked], start_place_, 7)) *
          0.5;
  drag_ = !left ? Drag::kTurn : event.shift ? Drag::kUpright : Drag::kLevel;
}

void PictureMouse::BeginSurface(const PictureView& view, const ButtonEvent& event,
                                WindowState* state) {
  const scene::SceneDescription scene = session::WithEdit(state->scene, state->edit);
  const auto picked =
      PickSurface(scene, start_, ImGui::GetFontSize() / (view.scale * state->frame.camera.fx));
  state->selected_surface = picked ? picked->phantom : -1;
  if (!picked) return;
  grip_ = *picked;
  start_surface_ = state->edit.phantoms[static_cast<std::size_t>(grip_.phantom)];
  drag_ = event.shift ? Drag::kSurfaceUpright : Drag::kSurface;
}

void PictureMouse::Continue(const PictureView& view, Vec2 screen, WindowState* state) {
  if (drag_ == Drag::kNone) return;
  // A click selects; only a drag moves.
  if (Norm(screen - start_screen_) < 2.0) return;
  const Sight sight = SightThrough(state->frame.camera, *state->frame.camera_from_marker,
                                   view.PixelFromScreen(screen));
  if (drag_ == Drag::kSurface || drag_ == Drag::kSurfaceUpright) {
    const auto moved = DraggedSurface(session::WithEdit(state->scene, state->edit), start_surface_,
                                      grip_, start_, sight, drag_ == Drag::kSurfaceUpright);
    if (moved) state->edit.phantoms[static_cast<std::size_t>(grip_.phantom)] = *moved;
    return;
  }
  const Vec3 up = UpOf(state->scene.marker);
  if (drag_ == Drag::kPoleFoot || drag_ == Drag::kPoleTip) {
    const auto on_ground = MeetPlane(sight, state->overlays.pole.foot, up);
    if (!on_ground) return;
    if (drag_ == Drag::kPoleFoot) {
      state->overlays.pole.foot = *on_ground;
    } else if (const auto heading = HeadingForShadow(state->scene.marker, state->overlays.pole,
                                                     *on_ground, ToSun(*state))) {
      state->edit.heading_deg = heading;
    }
    return;
  }
  if (state->selected < 0) return;
  session::ObjectPlace& place = state->edit.objects[state->selected];
  if (drag_ == Drag::kTurn) {
    const double share =
        (screen.x - start_screen_.x) / std::max(1.0F, ImGui::GetIO().DisplaySize.x);
    place = Turned(state->boxes[state->selected], start_place_, share * kDegreesAcrossAPicture, up);
    return;
  }
  place = drag_ == Drag::kUpright ? DraggedUpright(start_place_, start_, sight, hold_, up)
                                  : DraggedLevel(start_place_, start_, sight, hold_, up);
}

}  // namespace pleinair::app
