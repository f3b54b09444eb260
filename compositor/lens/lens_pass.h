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

/// Draws parts of a scene into the render targets, as a frame shows them.
struct SceneParts {
  LensViews::DrawFrame all, real;  ///< All with its light; the real surfaces' depth alone.
  std::function<ObjectDrawing(const FrameUniforms&)> objects;
  /// All with its light into tiles alone, for frames with BehindNearest.
  std::function<void(const FrameUniforms&, const ImageTiles&)> behind;
  /// Binds the camera image as RealOccluders::Estimate() requires.
  std::function<void()> bind_frame;
};

/// Depth of field and motion blur of the virtual image (docs/guide/lens.md). Each way returns the
/// real surfaces that cover objects over a part of the lens or of the exposure; null without any.
/// Takes memory on first use. Needs a current OpenGL context; move-only.
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

  /// Replaces the drawn image in `targets` by that of the lens at rest. Call SpreadOf() first.
  /// `camera`: that of the targets. Sets the layers and peels of `figures`. Errors as
  /// RealOccluders::Create().
  Result<const RealOccluders*> DrawLayers(RenderTargets& targets, const LensFrame& lens_frame,
                                          const RenderCamera& camera,
                                          std::span<const PixelRect> within,
                                          const SceneParts& parts, LensFigures* figures);

  /// Draws the mean over `poses` of the exposure, each by layers. Call SpreadOf() first. Sets
  /// `figures` as DrawLayers(). Errors as DrawViews().
  Result<const RealOccluders*> DrawLayersOfPoses(RenderTargets& targets,
                                                 const LensFrame& lens_frame,
                                                 const RenderCamera& camera, int poses,
                                                 std::span<const PixelRect> within,
                                                 const SceneParts& parts, LensFigures* figures);

  /// Draws the mean of the views. Errors as LensViews::Create() and RealOccluders::Create().
  Result<const RealOccluders*> DrawViews(const RenderTargets& targets, const AveragedViews& views,
                                         std::span<const PixelRect> within,
                                         const SceneParts& parts);

 private:
  /// The lens's image of the scene that is drawn in `targets`, captured in pinhole_. Their contents
  /// are lost. Adds to the layers and peels of `figures`.
  LensImage DrawCaptured(const RenderTargets& targets, const LensFrame& lens_frame,
                         const RenderCamera& camera, std::span<const PixelRect> within,
                         const SceneParts& parts, LensFigures* figures);
  Result<void> CreateViews(const RenderTargets& targets);
  /// Real surfaces that cover objects at these distances in a part of the views.
  Result<const RealOccluders*> OccludersIn(const RenderTargets& targets, const AveragedViews& views,
                                           std::span<const PixelRect> within,
                                           const ObjectDistances& objects, const SceneParts& parts);
  Result<const RealOccluders*> Occluders(const gl::GlTexture& share,
                                         std::span<const PixelRect> within,
                                         const SceneParts& parts);

  std::optional<PinholeCapture> capture_;
  std::optional<LensViews> views_;
  PinholeImage pinhole_;
  LayeredLens layers_;
  gl::GlTexture occluder_share_;  // On first use.
  std::optional<RealOccluders> occluders_;
};

}  // namespace pleinair::compositor
