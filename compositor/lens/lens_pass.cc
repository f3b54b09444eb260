#include "compositor/lens/lens_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pleinair::compositor {
namespace {

// Shares of the lens that do not count as occluded.
constexpr float kMinShare = 0.02F;

}  // namespace

Result<FrameSpread> LensPass::SpreadOf(const RenderTargets& targets, const LensFrame& lens_frame,
                                       const RenderCamera& camera, const ImageTiles& drawn) {
  const ThinLens& lens = lens_frame.lens;
  const std::vector<PixelRect> within = drawn.Rectangles();
  const auto circle = [&](double dioptres) {
    if (lens.aperture_m == 0.0) return 0.0;
    return std::fabs(
        SignedCircle_px(lens, camera.fx, std::min(dioptres, 1.0 / lens.MinDistance_m())));
  };
  const auto spread = [&](const DioptreRange& range) {
    return FrameSpread{
        std::max(circle(range.min), circle(range.max)),
        lens_frame.motion ? LongestStreak_px(camera, lens_frame.motion, within, range) : 0.0};
  };
  const shadows::View& view = lens_frame.view;
  // All of the scene may be in focus and at rest, which needs no image.
  const FrameSpread bound =
      spread({static_cast<float>(1.0 / view.far_m), static_cast<float>(1.0 / view.near_m)});
  if (bound.circle_px < kMinCircle_px && bound.streak_px < kMinStreak_px) return bound;
  if (!capture_) {
    PLEINAIR_ASSIGN_OR_RETURN(PinholeCapture capture,
                              PinholeCapture::Create(camera.width, camera.height));
    capture_.emplace(std::move(capture));
  }
  pinhole_ = capture_->Capture(targets, view, within);
  const DioptreRange range = AffectedDioptres(pinhole_, within);
  if (range.min > range.max) return FrameSpread{};
  return spread(range);
}

int LensPass::Spread_px(double circle_px) {
  return static_cast<int>(std::ceil(0.5 * 1.125 * circle_px)) + 2;
}

Result<const RealOccluders*> LensPass::DrawLayers(
    RenderTargets& targets, const LensFrame& lens_frame, const RenderCamera& camera,
    std::span<const PixelRect> within, const ObjectDrawing& objects,
    const std::function<void()>& bind_frame, LensFigures* figures) {
  capture_->AddHidden(targets, lens_frame.view, within, objects, &pinhole_);
  const LensImage drawn = layers_.Draw(pinhole_, lens_frame.lens, camera.fx, within);
  figures->layers = layers_.layers();
  figures->peels = pinhole_.objects_alone.empty() ? 0 : 1;
  targets.Replace(drawn.ratio, drawn.objects);
  const std::span shares(drawn.occluder_share.data(), drawn.occluder_share.size());
  if (std::ranges::all_of(shares, [](float share) { return share <= kMinShare; })) return nullptr;
  if (!occluder_share_) {
    PLEINAIR_ASSIGN_OR_RETURN(occluder_share_,
                              gl::GlTexture::Create2D(GL_R32F, camera.width, camera.height));
  }
  occluder_share_.Upload(GL_RED, GL_FLOAT, drawn.occluder_share.data());
  return Occluders(occluder_share_, within, bind_frame);
}

Result<void> LensPass::Draw(const RenderTargets& targets, const AveragedViews& views,
                            std::span<const PixelRect> within, const LensViews::DrawFrame& draw) {
  if (!views_) {
    PLEINAIR_ASSIGN_OR_RETURN(LensViews created,
                              LensViews::Create(targets.ratio().width(), targets.ratio().height()));
    views_.emplace(std::move(created));
  }
  views_->Draw(targets, views, within, draw);
  return {};
}

Result<const RealOccluders*> LensPass::OccludersIn(const RenderTargets& targets,
                                                   const AveragedViews& views,
                                                   std::span<const PixelRect> within,
                                                   const LensViews::DrawFrame& draw_real,
                                                   const std::function<void()>& bind_frame) {
  if (!views_->MeasureOccluders(targets, views, within, draw_real)) return nullptr;
  return Occluders(views_->occluder_share(), within, bind_frame);
}

Result<const RealOccluders*> LensPass::Occluders(const gl::GlTexture& share,
                                                 std::span<const PixelRect> within,
                                                 const std::function<void()>& bind_frame) {
  if (!occluders_) {
    PLEINAIR_ASSIGN_OR_RETURN(RealOccluders occluders,
                              RealOccluders::Create(share.width(), share.height()));
    occluders_.emplace(std::move(occluders));
  }
  bind_frame();
  occluders_->Estimate(share, within);
  return &*occluders_;
}

}  // namespace pleinair::compositor
