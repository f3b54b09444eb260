#pragma once

#include <vector>

#include "app/window/picture_view.h"
#include "app/window/surface_moves.h"
#include "app/window/window_state.h"

namespace pleinair::app {

/// Bounding boxes of a scene's objects; `placed` holds phantoms, then objects.
std::vector<ObjectBox> BoxesOf(const std::vector<compositor::PlacedModel>& placed,
                               const scene::SceneDescription& scene);

/// A mouse button pressed or released, with the mouse position at that time. During a slow frame
/// the mouse moves on.
struct ButtonEvent {
  enum class Button { kLeft, kRight };
  Button button = Button::kLeft;
  bool down = false;
  bool shift = false;
  Vec2 screen;
};

/// Mouse interaction over the image, and its overlays: the selected object's box, the
/// outlines of described surfaces, and the north pole. Within an ImGui frame.
class PictureMouse {
 public:
  /// `events`: since the last call, in order.
  void Update(const PictureView& view, const std::vector<ButtonEvent>& events, WindowState* state);

 private:
  enum class Drag {
    kNone,
    kLevel,
    kUpright,
    kTurn,
    kPoleFoot,
    kPoleTip,
    kSurface,
    kSurfaceUpright
  };

  void Begin(const PictureView& view, const ButtonEvent& event, WindowState* state);
  void BeginSurface(const PictureView& view, const ButtonEvent& event, WindowState* state);
  void Continue(const PictureView& view, Vec2 screen, WindowState* state);

  Drag drag_ = Drag::kNone;
  Vec2 start_screen_;
  Sight start_;
  Vec3 hold_;
  session::ObjectPlace start_place_;
  SurfaceGrip grip_;
  session::SurfacePlace start_surface_;
};

}  // namespace pleinair::app
