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

/// Draws the objects' surfaces alone.
void DrawObjects(const LensScene& scene, const FrameUniforms& frame, const AffectedTiles& tiles) {
  EnableSurfaceTests();
  scene.ratio.DrawSurfaces(scene.canvas.targets, scene.surfaces, frame, {});  // Clears.
  scene.objects.DrawSurfaces(scene.canvas.targets, scene.surfaces, frame, tiles.fine.Bounds());
  DisableSurfaceTests();
}

/// Shades what DrawObjects() has drawn.
void ShadeObjects(const LensScene& scene, const FrameUniforms& frame,
                  std::span<const PixelRect> within) {
  glEnable(GL_DEPTH_TEST);
  scene.light.BindShade();
  // The coverage of edges is that of the whole scene.
  scene.objects.Draw(scene.canvas.targets, scene.surfaces, CoveragePass(), scene.programs, frame,
                     scene.light.environment(), within);
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

/// What is drawn of the scene into the tiles. Both must outlive it.
SceneParts PartsOf(const LensScene& scene, const AffectedTiles& tiles) {
  Canvas& canvas = scene.canvas;
  return {.all =
              [&](const FrameUniforms& seen) {
                canvas.places.Draw(canvas.targets, seen, tiles.fine.Rectangles(),
                                   [&](const FrameUniforms& place) { scene.draw(place, tiles); });
              },
          .real =
              [&](const FrameUniforms& seen) {
                EnableSurfaceTests();
                scene.ratio.DrawSurfaces(canvas.targets, scene.surfaces, seen, tiles.fine.Bounds());
                DisableSurfaceTests();
              },
          .objects =
              [&](const FrameUniforms& seen) {
                return ObjectDrawing{
                    [&] { DrawObjects(scene, seen, tiles); },
                    [&](std::span<const PixelRect> within) { ShadeObjects(scene, seen, within); }};
              },
          .behind =
              [&](const FrameUniforms& seen, const ImageTiles& within) {
                const AffectedTiles part{within, within, tiles.all};
                canvas.places.Draw(canvas.targets, seen, within.Rectangles(),
                                   [&](const FrameUniforms& place) { scene.draw(place, part); });
              },
          .bind_frame = [&] { canvas.picture.BindForShading(2, 3, 4); }};
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

LensDrawing::Way LensDrawing::WayOf(const FrameSpread& spread) const {
  const bool is_moved = spread.streak_px >= LensPass::kMinStreak_px;
  const bool is_blurred = spread.circle_px >= LensPass::kMinCircle_px;
  if (!is_moved && !is_blurred) return {};
  if (!is_moved) return {places_ == kByLayers, places_};
  // Edges step by a pixel from one pose to the next, which their coverage of pixels smooths. Where
  // places on the stop are drawn as well, edges step across streak and circle together.
  const bool by_layers = is_blurred && places_ == kByLayers;
  const double steps =
      is_blurred && !by_layers ? 2.0 * (spread.streak_px + spread.circle_px) : spread.streak_px;
  const int views = static_cast<int>(std::ceil(std::clamp(steps, 2.0, 1.0 * max_views_)));
  return {by_layers, by_layers ? views : std::max(places_, views)};
}

Result<const RealOccluders*> LensDrawing::Draw(const LensScene& scene, const FrameUniforms& frame,
                                               const shadows::View& view, AffectedTiles* tiles) {
  figures_ = {};
  if (!lens_ && !motion_) return nullptr;
  Canvas& canvas = scene.canvas;
  const LensFrame lens{frame, view, lens_.value_or(ThinLens{}), motion_};
  PLEINAIR_ASSIGN_OR_RETURN(const FrameSpread spread,
                            Measure(canvas, lens, scene.camera_fx, tiles->fine));
  const Way way = WayOf(spread);
  const int spread_px = PixelsOf(spread);
  if (spread_px == 0) return nullptr;
  const SceneParts parts = PartsOf(scene, *tiles);
  if (way.views == kByLayers) {
    if (spread_px > scene.spread_px) {
      // Shadows may lie far from the objects. The image then needs more pixels around it.
      *tiles = scene.draw_pinhole(spread_px);
      PLEINAIR_RETURN_IF_ERROR(Measure(canvas, lens, scene.camera_fx, tiles->fine));
    }
    return canvas.lens.DrawLayers(canvas.targets, lens, canvas.camera, tiles->fine.Rectangles(),
                                  parts, &figures_);
  }
  figures_.views = way.views;
  *tiles = scene.surfaces.TilesOf(ProjectionOf(
      canvas.camera, view, canvas.picture.Spread_px() + canvas.places.Spread_px() + spread_px));
  if (scene.includes_all) tiles->all.IncludeAll();
  // Nothing is interpolated from the coarse ratio, which is not blurred.
  tiles->fine.Include(tiles->all);
  tiles->fine = canvas.picture.SetTiles(*tiles, canvas.DrawnInk());
  tiles->objects = tiles->fine;
  const std::vector<PixelRect> within = tiles->fine.Rectangles();
  if (way.by_layers) {
    return canvas.lens.DrawLayersOfPoses(canvas.targets, lens, canvas.camera, way.views, within,
                                         parts, &figures_);
  }
  return canvas.lens.DrawViews(canvas.targets, ExposureViews(lens, canvas.camera, way.views),
                               within, parts);
}

}  // namespace pleinair::compositor
