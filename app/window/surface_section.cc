#include "app/window/surface_section.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>

#include "app/window/north_pole.h"
#include "app/window/surface_moves.h"

namespace pleinair::app {
namespace {

constexpr double kMaxHeight_m = 1e3;

/// Numbers of the chosen surface.
void ChosenSurface(const scene::SceneDescription& scene, std::size_t index, WindowState* state) {
  session::SurfacePlace& place = state->edit.phantoms[index];
  switch (scene.phantoms[index].surface->kind) {
    case scene::SurfaceKind::kGround: {
      const double before_m = GroundHeight(scene, scene.phantoms[index]);
      double height_m = before_m;
      if (ImGui::DragScalar("marker above it m", ImGuiDataType_Double, &height_m, 0.005F, nullptr,
                            nullptr, "%.3f")) {
        height_m = std::clamp(height_m, 0.0, kMaxHeight_m);
        place.translation_m = place.translation_m + UpOf(scene.marker) * (before_m - height_m);
      }
      break;
    }
    case scene::SurfaceKind::kBox: {
      double numbers[3] = {place.translation_m.x, place.translation_m.y, place.translation_m.z};
      if (ImGui::DragScalarN("moved by m", ImGuiDataType_Double, numbers, 3, 0.005F, nullptr,
                             nullptr, "%.3f")) {
        place.translation_m = {numbers[0], numbers[1], numbers[2]};
      }
      break;
    }
    case scene::SurfaceKind::kWall:
      ImGui::TextWrapped("Drag a corner, or the wall along its normal.");
      break;
  }
  if (ImGui::Button("Reset##surface")) Do(Action::kResetObject, false, {}, state);
}

}  // namespace

void DrawSurfaceSection(WindowState* state) {
  const scene::SceneDescription scene = session::WithEdit(state->scene, state->edit);
  bool any = false;
  for (const scene::ModelReference& phantom : scene.phantoms) any = any || phantom.surface;
  if (!any) {
    ImGui::TextWrapped("the scene has no ground, box or wall of its own");
    return;
  }
  ImGui::Checkbox("move them (G)", &state->overlays.moving_surfaces);
  if (!state->overlays.moving_surfaces) return;
  for (std::size_t i = 0; i < scene.phantoms.size(); ++i) {
    if (!scene.phantoms[i].surface) continue;
    const int number = static_cast<int>(i);
    ImGui::PushID(number);
    if (ImGui::Selectable(scene.phantoms[i].surface->name.c_str(),
                          state->selected_surface == number)) {
      state->selected_surface = number;
    }
    ImGui::PopID();
  }
  const auto chosen = static_cast<std::size_t>(state->selected_surface);
  if (chosen >= scene.phantoms.size() || !scene.phantoms[chosen].surface) return;
  ChosenSurface(scene, chosen, state);
}

}  // namespace pleinair::app
