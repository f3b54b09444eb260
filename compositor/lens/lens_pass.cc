#include "compositor/lens/lens_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/image.h"

namespace pleinair::compositor {
namespace {

// Shares of the lens that do not count as occluded.
constexpr float kMinShare = 0.02F;

// Views at least by which the part of lens and exposure is measured that real surfaces cover. They
// draw depth alone.
constexpr int kOccluderViews = 32;

/// The mean of images by layers.
class LayersOfPoses {
 public:
  LayersOfPoses(int width, int height)
      : ratio_(width, height, 4),
        objects_(width, height, 4),
        dioptres_(width, height),
        share_(width, height) {}

  void Add(const PinholeImage& pinhole, const LensImage& drawn, float weight) {
    for (std::size_t i = 0; i < ratio_.size(); ++i) {
      ratio_.data()[i] += weight * drawn.ratio.data()[i];
      objects_.data()[i] += weight * drawn.objects.data()[i];
    }
    for (std::size_t i = 0; i < share_.size(); ++i) {
      const float share = weight * pinhole.objects.data()[4 * i + 3];
      dioptres_.data()[i] += share * pinhole.dioptres.data()[4 * i + PinholeImage::kObject];
      share_.data()[i] += share;
    }
  }

  const Image<float>& ratio() const { return ratio_; }
  const Image<float>& objects() const { return objects_; }
  ObjectDistances Distances() const {
    ObjectDistances objects{dioptres_, share_};
    for (std::size_t i = 0; i < share_.size(); ++i) {
      if (share_.data()[i] > 0.0F) objects.dioptres.data()[i] /= share_.data()[i];
    }
    return objects;
  }

 private:
  Image<float> ratio_, objects_, dioptres_, share_;
};

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

LensImage LensPass::DrawCaptured(const RenderTargets& targets, const LensFrame& lens_frame,
                                 const RenderCamera& camera, std::span<const PixelRect> within,
                                 const SceneParts& parts, LensFigures* figures) {
  const shadows::View& view = lens_frame.view;
  capture_->AddHidden(targets, view, within, parts.objects(lens_frame.frame), &pinhole_);
  layers_.Begin(pinhole_, lens_frame.lens, camera.fx, within);
  const NeededBehind& behind = layers_.behind();
  HiddenImage hidden;
  if (behind.tiles.Count() > 0) {
    hidden = capture_->CaptureBehind(targets, view, behind.tiles, behind.max_dioptres,
                                     [&](const BehindNearest& nearest) {
                                       FrameUniforms frame = lens_frame.frame;
                                       frame.place.behind = nearest;
                                       parts.behind(frame, behind.tiles);
                                     });
  }
  LensImage drawn = layers_.Draw(hidden);
  figures->layers = std::max(figures->layers, layers_.layers());
  const int peels = (pinhole_.objects_alone.empty() ? 0 : 1) + (hidden.objects.empty() ? 0 : 1);
  figures->peels = std::max(figures->peels, peels);
  return drawn;
}

Result<const RealOccluders*> LensPass::DrawLayers(RenderTargets& targets,
                                                  const LensFrame& lens_frame,
                                                  const RenderCamera& camera,
                                                  std::span<const PixelRect> within,
                                                  const SceneParts& parts, LensFigures* figures) {
  const LensImage drawn = DrawCaptured(targets, lens_frame, camera, within, parts, figures);
  targets.Replace(drawn.ratio, drawn.objects);
  const std::span shares(drawn.occluder_share.data(), drawn.occluder_share.size());
  if (std::ranges::all_of(shares, [](float share) { return share <= kMinShare; })) return nullptr;
  if (!occluder_share_) {
    PLEINAIR_ASSIGN_OR_RETURN(occluder_share_,
                              gl::GlTexture::Create2D(GL_R32F, camera.width, camera.height));
  }
  occluder_share_.Upload(GL_RED, GL_FLOAT, drawn.occluder_share.data());
  return Occluders(occluder_share_, within, parts);
}

Result<const RealOccluders*> LensPass::DrawLayersOfPoses(
    RenderTargets& targets, const LensFrame& lens_frame, const RenderCamera& camera, int poses,
    std::span<const PixelRect> within, const SceneParts& parts, LensFigures* figures) {
  const LensFrame pinhole{lens_frame.frame, lens_frame.view, {}, lens_frame.motion};
  const AveragedViews views = ExposureViews(pinhole, camera, poses);
  LayersOfPoses mean(camera.width, camera.height);
  for (std::size_t i = 0; i < views.frames.size(); ++i) {
    const FrameUniforms& frame = views.frames[i];
    parts.all(frame);
    pinhole_ = capture_->Capture(targets, views.planes, within);
    const LensFrame pose{frame, views.planes, lens_frame.lens};
    const LensImage drawn = DrawCaptured(targets, pose, camera, within, parts, figures);
    mean.Add(pinhole_, drawn, WeightOfView(i, views.frames.size()));
  }
  targets.Replace(mean.ratio(), mean.objects());
  // Surfaces before objects cover them over a part of lens and exposure in common.
  PLEINAIR_RETURN_IF_ERROR(CreateViews(targets));
  const int places = std::max(poses, kOccluderViews);
  return OccludersIn(targets, ExposureViews(lens_frame, camera, places), within, mean.Distances(),
                     parts);
}

Result<const RealOccluders*> LensPass::DrawViews(const RenderTargets& targets,
                                                 const AveragedViews& views,
                                                 std::span<const PixelRect> within,
                                                 const SceneParts& parts) {
  PLEINAIR_RETURN_IF_ERROR(CreateViews(targets));
  views_->Draw(targets, views, within, parts.all);
  return OccludersIn(targets, views, within, views_->Distances(), parts);
}

Result<void> LensPass::CreateViews(const RenderTargets& targets) {
  if (views_) return {};
  PLEINAIR_ASSIGN_OR_RETURN(LensViews created,
                            LensViews::Create(targets.ratio().width(), targets.ratio().height()));
  views_.emplace(std::move(created));
  return {};
}

Result<const RealOccluders*> LensPass::OccludersIn(const RenderTargets& targets,
                                                   const AveragedViews& views,
                                                   std::span<const PixelRect> within,
                                                   const ObjectDistances& objects,
                                                   const SceneParts& parts) {
  if (!views_->MeasureOccluders(targets, views, within, objects, parts.real)) return nullptr;
  return Occluders(views_->occluder_share(), within, parts);
}

Result<const RealOccluders*> LensPass::Occluders(const gl::GlTexture& share,
                                                 std::span<const PixelRect> within,
                                                 const SceneParts& parts) {
  if (!occluders_) {
    PLEINAIR_ASSIGN_OR_RETURN(RealOccluders occluders,
                              RealOccluders::Create(share.width(), share.height()));
    occluders_.emplace(std::move(occluders));
  }
  parts.bind_frame();
  occluders_->Estimate(share, within);
  return &*occluders_;
}

}  // namespace pleinair::compositor
