#include "compositor/ink_drawing.h"

#include "compositor/passes/scene_view.h"

namespace pleinair::compositor {

Result<void> InkDrawing::SetShapes(std::span<const InkShape> shapes, const Mat3& marker_from_world,
                                   SceneSurfaces* surfaces, Canvas* canvas) {
  PLEINAIR_RETURN_IF_ERROR(pass_.SetShapes(shapes, marker_from_world));
  surfaces->NumberAll(!pass_.empty());
  if (pass_.empty()) canvas->ink = {};
  return {};
}

Result<void> InkDrawing::Draw(const InkScene& scene, const shadows::View& view,
                              const FrameUniforms& frame, Canvas* canvas) {
  if (pass_.empty()) return {};
  if (!canvas->ink.kept) {
    PLEINAIR_ASSIGN_OR_RETURN(canvas->ink,
                              InkImages::Create(canvas->camera.width, canvas->camera.height));
  }
  canvas->ink.tiles =
      pass_.TilesOf(ProjectionOf(canvas->camera, view, 0), scene.surfaces.placement().bounds());
  canvas->picture.BindForShading(2, 3, 4);
  scene.light.BindShade();
  return pass_.Draw(canvas->targets, scene.surfaces, scene.ratio, frame, scene.unmodelled,
                    {.blur_px = static_cast<float>(canvas->picture.Blur_px()),
                     .render_px = static_cast<float>(canvas->picture.supersampling()),
                     .maps = scene.shadows.options(),
                     .fades = scene.shadows.Fades()},
                    canvas->ink);
}

}  // namespace pleinair::compositor
