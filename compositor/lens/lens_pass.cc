#include "compositor/lens/lens_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pleinair::compositor {

Result<double> LensPass::LargestCircle_px(const RenderTargets& targets, const LensFrame& lens_frame,
                                          const RenderCamera& camera, const ImageTiles& drawn) {
  const ThinLens& lens = lens_frame.lens;
  const auto circle = [&](double dioptres) {
    return std::fabs(
        SignedCircle_px(lens, camera.fx, std::min(dioptres, 1.0 / lens.MinDistance_m())));
  };
  const shadows::View& view = lens_frame.view;
  // All of the scene may be in focus, which needs no image.
  const double bound = std::max(circle(1.0 / view.near_m), circle(1.0 / view.far_m));
  if (bound < kMinCircle_px) return bound;
  if (!views_) {
    PLEINAIR_ASSIGN_OR_RETURN(LensViews views, LensViews::Create(camera.width, camera.height));
    views_.emplace(std::move(views));
  }
  const LensViews::Range range = views_->AffectedDioptres(targets, view, drawn.Rectangles());
  if (range.min > range.max) return 0.0;
  return std::max(circle(range.min), circle(range.max));
}

int LensPass::Spread_px(double circle_px) {
  return static_cast<int>(std::ceil(0.5 * 1.125 * circle_px)) + 2;
}

void LensPass::Draw(const RenderTargets& targets, const LensFrame& lens_frame,
                    std::span<const PixelRect> within, const LensViews::DrawFrame& draw) const {
  views_->Draw(targets, lens_frame, within, draw);
}

Result<const RealOccluders*> LensPass::OccludersIn(const RenderTargets& targets,
                                                   const LensFrame& lens_frame,
                                                   std::span<const PixelRect> within,
                                                   const LensViews::DrawFrame& draw_real,
                                                   const std::function<void()>& bind_frame) {
  if (!views_->MeasureOccluders(targets, lens_frame, within, draw_real)) return nullptr;
  if (!occluders_) {
    PLEINAIR_ASSIGN_OR_RETURN(
        RealOccluders occluders,
        RealOccluders::Create(targets.ratio().width(), targets.ratio().height()));
    occluders_.emplace(std::move(occluders));
  }
  bind_frame();
  occluders_->Estimate(views_->occluder_share(), within);
  return &*occluders_;
}

}  // namespace pleinair::compositor
