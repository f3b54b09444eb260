#include "compositor/lens_drawing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "compositor/lens/lens_pass.h"
#include "compositor/passes/scene_view.h"

namespace pleinair::compositor {
namespace {

void DisableSurfaceTests() {
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
}

/// Pixels around objects that a spread reaches; 0: it is not drawn.
int PixelsOf(const FrameSpread& spread) {
  int pixels = 0;
  if (spread.circle_px >= LensPass::kMinCircle_px) pixels += LensPass::Spread_px(spread.circle_px);
  if (spread.streak_px >= LensPass::kMinStreak_px) {
    pixels += static_cast<int>(std::ceil(0.5 * spread.streak_px)) + 1;
  }
  return pixels;
}

}  // namespace

int LensDrawing::AssumedSpread_px(const RenderCamera& camera, const shadows::View& view,
                                  const shadows::Box& objects) const {
  if (!lens_) return 0;
  double circle_px = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto pick = [&](int axis) {
      return (corner >> axis & 1) == 0 ? objects.min[axis] : objects.max[axis];
    };
    const glm::dvec4 at_m = view.camera_from_marker * glm::dvec4(pick(0), pick(1), pick(2), 1.0);
    const double distance_m = std::max(at_m.z, lens_->MinDistance_m());
    circle_px = std::max(circle_px, CircleOfConfusion_px(*lens_, camera.fx, distance_m));
  }
  // Shadows around the objects have other circles.
  constexpr double kAround = 1.3;
  return circle_px < LensPass::kMinCircle_px ? 0 : LensPass::Spread_px(kAround * circle_px);
}

Result<FrameSpread> LensDrawing::Measure(Canvas& canvas, const LensFrame& lens, double camera_fx,
                                         const ImageTiles& drawn) {
  PLEINAIR_ASSIGN_OR_RETURN(const FrameSpread spread,
                            canvas.lens.SpreadOf(canvas.targets, lens, canvas.camera, drawn));
  const double scale = camera_fx / canvas.camera.fx;
  figures_ = {.largest_circle_px = spread.circle_px * scale,
              .longest_streak_px = spread.streak_px * scale};
  return spread;
}

int LensDrawing::ViewsFor(const FrameSpread& spread) const {
  if (spread.streak_px < LensPass::kMinStreak_px) return places_;
  // Edges step by half a pixel from one view to the next, across streak and circle together.
  constexpr double kViewsPerPixel = 2.0;
  const double wanted = kViewsPerPixel * (spread.streak_px + spread.circle_px);
  const int views = static_cast<int>(std::ceil(std::clamp(wanted, 2.0, 1.0 * max_views_)));
  return std::max(places_, views);
}

Result<const RealOccluders*> LensDrawing::Draw(const LensScene& scene, const FrameUniforms& frame,
                                               const shadows::View& view, AffectedTiles* tiles) {
  figures_ = {};
  if (!lens_ && !motion_) return nullptr;
  Canvas& canvas = scene.canvas;
  const LensFrame lens{frame, view, lens_.value_or(ThinLens{}), motion_};
  PLEINAIR_ASSIGN_OR_RETURN(const FrameSpread spread,
                            Measure(canvas, lens, scene.camera_fx, tiles->fine));
  const int views = ViewsFor(spread);
  const int spread_px = PixelsOf(spread);
  if (spread_px == 0) return nullptr;
  if (views == kByLayers && spread_px > scene.spread_px) {
    // Shadows may lie far from the objects. The image then needs more pixels around it.
    *tiles = scene.draw_pinhole(spread_px);
    PLEINAIR_RETURN_IF_ERROR(Measure(canvas, lens, scene.camera_fx, tiles->fine));
  }
  if (views != kByLayers) {
    figures_.views = views;
    *tiles = scene.surfaces.TilesOf(ProjectionOf(
        canvas.camera, view, canvas.picture.Spread_px() + canvas.places.Spread_px() + spread_px));
    if (scene.includes_all) tiles->all.IncludeAll();
    // Nothing is interpolated from the coarse ratio, which is not blurred.
    tiles->fine.Include(tiles->all);
    tiles->fine = canvas.picture.SetTiles(*tiles);
    tiles->objects = tiles->fine;
  }
  const std::vector<PixelRect> within = tiles->fine.Rectangles();
  const auto bind_frame = [&] { canvas.picture.BindForShading(2, 3, 4); };
  const auto draw_real = [&](const FrameUniforms& through) {
    EnableSurfaceTests();
    scene.ratio.DrawSurfaces(canvas.targets, scene.surfaces, through, tiles->fine.Bounds());
    DisableSurfaceTests();
  };
  const auto draw_objects = [&] {
    EnableSurfaceTests();
    scene.ratio.DrawSurfaces(canvas.targets, scene.surfaces, frame, {});  // Clears.
    scene.objects.DrawSurfaces(canvas.targets, scene.surfaces, frame, tiles->fine.Bounds());
    DisableSurfaceTests();
  };
  const auto shade_objects = [&](std::span<const PixelRect> hidden) {
    glEnable(GL_DEPTH_TEST);
    scene.light.BindShade();
    // The coverage of edges is that of the whole scene.
    scene.objects.Draw(canvas.targets, scene.surfaces, CoveragePass(), scene.programs, frame,
                       scene.light.environment(), hidden);
    glDisable(GL_DEPTH_TEST);
  };
  if (views == kByLayers) {
    return canvas.lens.DrawLayers(canvas.targets, lens, canvas.camera, within,
                                  {draw_objects, shade_objects}, bind_frame, &figures_);
  }
  const AveragedViews averaged = ExposureViews(lens, canvas.camera, views);
  PLEINAIR_RETURN_IF_ERROR(
      canvas.lens.Draw(canvas.targets, averaged, within, [&](const FrameUniforms& through) {
        canvas.places.Draw(canvas.targets, through, within,
                           [&](const FrameUniforms& place) { scene.draw(place, *tiles); });
      }));
  return canvas.lens.OccludersIn(canvas.targets, averaged, within, draw_real, bind_frame);
}

}  // namespace pleinair::compositor
