#pragma once

#include <functional>
#include <optional>

#include "base/error.h"
#include "compositor/canvas.h"
#include "compositor/lens/real_occluders.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// What a lens is drawn with.
struct LensScene {
  Canvas& canvas;
  const SceneSurfaces& surfaces;  ///< Classified.
  const ShadowRatioPass& ratio;
  bool includes_all = false;  ///< Draws all tiles of the image.
  double camera_fx = 0.0;     ///< Focal length of the camera image, pixels.
  /// Draws the scene as a frame shows it into the tiles.
  std::function<void(const FrameUniforms&, const AffectedTiles&)> draw;
};

/// The lens of a Composer, and how much of its last image was out of focus.
class LensDrawing {
 public:
  /// As Composer::SetLens().
  void SetLens(const std::optional<ThinLens>& lens, int places) {
    lens_ = lens;
    places_ = places;
  }
  /// As Composer::LargestCircle_px().
  double largest_circle_px() const { return largest_circle_px_; }

  /// Draws the image anew as the lens shows it, if anything is out of focus. The pinhole image must
  /// be drawn. `tiles`: those of that image, then those of the lens. Returns the real surfaces that
  /// cover objects over a part of the lens; null without any. Errors as LensViews::Create().
  Result<const RealOccluders*> Draw(const LensScene& scene, const FrameUniforms& frame,
                                    const shadows::View& view, AffectedTiles* tiles);

 private:
  std::optional<ThinLens> lens_;
  int places_ = 1;
  double largest_circle_px_ = 0.0;
};

}  // namespace pleinair::compositor
