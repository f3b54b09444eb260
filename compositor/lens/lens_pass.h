#pragma once

#include <functional>
#include <optional>
#include <span>

#include "base/error.h"
#include "compositor/lens/exposure_views.h"
#include "compositor/lens/layered_lens.h"
#include "compositor/lens/lens_figures.h"
#include "compositor/lens/lens_views.h"
#include "compositor/lens/pinhole_capture.h"
#include "compositor/lens/real_occluders.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/render_targets.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// Depth of field and motion blur of the virtual image (docs/guide/lens.md). Takes memory on first
/// use. Needs a current OpenGL context; move-only.
class LensPass {
 public:
  /// Smaller circles of confusion are not drawn, camera pixels.
  static constexpr double kMinCircle_px = DiscKernels::kMinCircle_px;

  /// Nor are shorter streaks.
  static constexpr double kMinStreak_px = 0.3;

  /// Returns how far all that virtual objects affect in the drawn `targets` is spread at most.
  /// Errors as PinholeCapture::Create().
  Result<FrameSpread> SpreadOf(const RenderTargets& targets, const LensFrame& lens_frame,
                               const RenderCamera& camera, const ImageTiles& drawn);

  /// Pixels by which circles of this diameter spread what is drawn. What the pinhole image hides
  /// may have a larger circle than all that it shows: an eighth and two pixels are added.
  static int Spread_px(double circle_px);

  /// Replaces the drawn image in `targets` by that of the lens. Call SpreadOf() first.
  /// `camera`: that of the targets. `bind_frame` as OccludersIn(). Sets
  /// the layers and peels of `figures`. Returns as that, too. Errors as PinholeCapture::Create()
  /// and RealOccluders::Create().
  Result<const RealOccluders*> DrawLayers(RenderTargets& targets, const LensFrame& lens_frame,
                                          const RenderCamera& camera,
                                          std::span<const PixelRect> within,
                                          const ObjectDrawing& objects,
                                          const std::function<void()>& bind_frame,
                                          LensFigures* figures);

  /// As LensViews::Draw(). Errors as LensViews::Create().
  Result<void> Draw(const RenderTargets& targets, const AveragedViews& views,
                    std::span<const PixelRect> within, const LensViews::DrawFrame& draw);

  /// Real surfaces that cover objects in a part of the views, after Draw(); null without any.
  /// `draw_real`: as LensViews::MeasureOccluders(). `bind_frame` has to bind the camera image, as
  /// RealOccluders::Estimate() requires. Errors as RealOccluders::Create().
  Result<const RealOccluders*> OccludersIn(const RenderTargets& targets, const AveragedViews& views,
                                           std::span<const PixelRect> within,
                                           const LensViews::DrawFrame& draw_real,
                                           const std::function<void()>& bind_frame);

 private:
  Result<const RealOccluders*> Occluders(const gl::GlTexture& share,
                                         std::span<const PixelRect> within,
                                         const std::function<void()>& bind_frame);

  std::optional<PinholeCapture> capture_;
  std::optional<LensViews> views_;
  PinholeImage pinhole_;
  LayeredLens layers_;
  gl::GlTexture occluder_share_;  // On first use.
  std::optional<RealOccluders> occluders_;
};

}  // namespace pleinair::compositor
