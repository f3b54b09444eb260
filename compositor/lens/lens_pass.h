#pragma once

#include <functional>
#include <optional>
#include <span>

#include "base/error.h"
#include "compositor/lens/lens_views.h"
#include "compositor/lens/real_occluders.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/render_targets.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// Depth of field of the virtual image (docs/guide/lens.md). Takes memory on first use.
/// Needs a current OpenGL context; move-only.
class LensPass {
 public:
  /// Smaller circles of confusion are not drawn, camera pixels.
  static constexpr double kMinCircle_px = 0.3;

  /// Returns the diameter of the largest circle of confusion over all that virtual objects affect
  /// in the drawn `targets`, render pixels. Errors as LensViews::Create().
  Result<double> LargestCircle_px(const RenderTargets& targets, const LensFrame& lens_frame,
                                  const RenderCamera& camera, const ImageTiles& drawn);

  /// Pixels by which circles of this diameter spread what is drawn. What the pinhole image hides
  /// may have a larger circle than all that it shows: an eighth and two pixels are added.
  static int Spread_px(double circle_px);

  /// As LensViews::Draw(). Call LargestCircle_px() first.
  void Draw(const RenderTargets& targets, const LensFrame& lens_frame,
            std::span<const PixelRect> within, const LensViews::DrawFrame& draw) const;

  /// Real surfaces that cover objects over a part of the lens, after Draw(); null without any.
  /// `draw_real`: as LensViews::MeasureOccluders(). `bind_frame` has to bind the camera image, as
  /// RealOccluders::Estimate() requires. Errors as RealOccluders::Create().
  Result<const RealOccluders*> OccludersIn(const RenderTargets& targets,
                                           const LensFrame& lens_frame,
                                           std::span<const PixelRect> within,
                                           const LensViews::DrawFrame& draw_real,
                                           const std::function<void()>& bind_frame);

 private:
  std::optional<LensViews> views_;
  std::optional<RealOccluders> occluders_;
};

}  // namespace pleinair::compositor
