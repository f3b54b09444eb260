#pragma once

#include <functional>
#include <optional>
#include <span>

#include "base/error.h"
#include "compositor/canvas.h"
#include "compositor/lens/camera_motion.h"
#include "compositor/lens/exposure_views.h"
#include "compositor/lens/lens_figures.h"
#include "compositor/lens/real_occluders.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/passes/frame_daylight.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/object_pass.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// What a lens is drawn with.
struct LensScene {
  Canvas& canvas;
  const SceneSurfaces& surfaces;  ///< Classified.
  const ShadowRatioPass& ratio;
  const ObjectPass& objects;
  const SurfacePrograms& programs;
  const FrameDaylight& light;
  bool includes_all = false;  ///< Draws all tiles of the image.
  double camera_fx = 0.0;     ///< Focal length of the camera image, pixels.
  int spread_px = 0;          ///< By which the drawn pinhole image has more pixels than needed.
  /// Draws the pinhole image with such a spread, and returns its tiles.
  std::function<AffectedTiles(int)> draw_pinhole;
  /// Draws the scene as a frame shows it into the tiles.
  std::function<void(const FrameUniforms&, const AffectedTiles&)> draw;
};

/// The lens of a Composer and its motion, and how much of its last image was blurred by them.
class LensDrawing {
 public:
  /// As Composer::SetLens().
  void SetLens(const std::optional<ThinLens>& lens, int places) {
    lens_ = lens;
    places_ = places;
  }
  /// As Composer::SetMotion().
  void SetMotion(const CameraMotion& motion, int max_views) {
    motion_ = motion;
    max_views_ = max_views;
  }
  /// As Composer::DrawnLens().
  const LensFigures& figures() const { return figures_; }

  /// Pixels by which the lens spreads objects in these bounds. 0: they are in focus.
  int AssumedSpread_px(const RenderCamera& camera, const shadows::View& view,
                       const shadows::Box& objects) const;

  /// Draws the image anew as the moving lens shows it, if anything is out of focus or moves. The
  /// pinhole image must be drawn. `tiles`: those of that image, then those of the lens. Returns the
  /// real surfaces that cover objects over a part of the lens or of the exposure; null without any.
  /// Errors as LensViews::Create().
  Result<const RealOccluders*> Draw(const LensScene& scene, const FrameUniforms& frame,
                                    const shadows::View& view, AffectedTiles* tiles);

 private:
  /// Sets the figures of the drawn pinhole image, and returns how far it is spread. Errors as
  /// LensViews::Create().
  Result<FrameSpread> Measure(Canvas& canvas, const LensFrame& lens, double camera_fx,
                              const ImageTiles& drawn);
  /// How an image is drawn.
  struct Way {
    bool by_layers = true;  ///< Each view by layers of depth.
    int views = kByLayers;  ///< Averaged; kByLayers: none, the image is at rest.
  };
  Way WayOf(const FrameSpread& spread) const;

  std::optional<ThinLens> lens_;
  CameraMotion motion_;
  int max_views_ = 1;
  int places_ = kByLayers;
  LensFigures figures_;
};

}  // namespace pleinair::compositor
