#include "compositor/lens_drawing.h"

#include <epoxy/gl.h>

#include <vector>

#include "compositor/lens/lens_pass.h"
#include "compositor/passes/scene_view.h"

namespace pleinair::compositor {

Result<const RealOccluders*> LensDrawing::Draw(const LensScene& scene, const FrameUniforms& frame,
                                               const shadows::View& view, AffectedTiles* tiles) {
  largest_circle_px_ = 0.0;
  if (!lens_) return nullptr;
  Canvas& canvas = scene.canvas;
  const LensFrame lens{frame, view, *lens_, places_};
  PLEINAIR_ASSIGN_OR_RETURN(
      const double circle_px,
      canvas.lens.LargestCircle_px(canvas.targets, lens, canvas.camera, tiles->fine));
  largest_circle_px_ = circle_px * scene.camera_fx / canvas.camera.fx;
  if (largest_circle_px_ < LensPass::kMinCircle_px) return nullptr;
  *tiles = scene.surfaces.TilesOf(ProjectionOf(
      canvas.camera, view,
      canvas.picture.Spread_px() + canvas.places.Spread_px() + LensPass::Spread_px(circle_px)));
  if (scene.includes_all) tiles->all.IncludeAll();
  // Nothing is interpolated from the coarse ratio, which is not blurred.
  tiles->fine.Include(tiles->all);
  tiles->fine = canvas.picture.SetTiles(*tiles);
  tiles->objects = tiles->fine;
  const std::vector<PixelRect> within = tiles->fine.Rectangles();
  canvas.lens.Draw(canvas.targets, lens, within, [&](const FrameUniforms& through) {
    canvas.places.Draw(canvas.targets, through, within,
                       [&](const FrameUniforms& place) { scene.draw(place, *tiles); });
  });
  return canvas.lens.OccludersIn(
      canvas.targets, lens, within,
      [&](const FrameUniforms& through) {
        EnableSurfaceTests();
        scene.ratio.DrawSurfaces(canvas.targets, scene.surfaces, through, tiles->fine.Bounds());
        glDisable(GL_CULL_FACE);
        glDisable(GL_DEPTH_TEST);
      },
      [&] { canvas.picture.BindForShading(2, 3, 4); });
}

}  // namespace pleinair::compositor
