#include "compositor/passes/coarse_ratio.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "compositor/passes/scene_view.h"

namespace pleinair::compositor {
namespace {

/// Returns whether adjacent values differ too much that pixels of a tile are interpolated from.
bool HasJump(const Image<float>& values, const PixelRect& tile) {
  constexpr int kStep = CoarseRatio::kStep_px;
  const int left = std::max(tile.x / kStep - 1, 0), top = std::max(tile.y / kStep - 1, 0);
  const int right = std::min((tile.x + tile.width) / kStep, values.width() - 1);
  const int bottom = std::min((tile.y + tile.height) / kStep, values.height() - 1);
  // Written so that a value which is not a number is a jump.
  const auto is_even = [&values](int x, int y, int next_x, int next_y) {
    for (int c = 0; c < 3; ++c) {
      const float difference = std::abs(values(x, y, c) - values(next_x, next_y, c));
      if (!(difference <= CoarseRatio::kMaxJump)) return false;
    }
    return true;
  };
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      if (!is_even(x, y, std::min(x + 1, right), y)) return true;
      if (!is_even(x, y, x, std::min(y + 1, bottom))) return true;
    }
  }
  return false;
}

}  // namespace

Result<CoarseRatio> CoarseRatio::Create(const RenderCamera& camera, bool blended) {
  CoarseRatio coarse;
  coarse.camera_ = CoarserBy(kStep_px, camera);
  PLEINAIR_ASSIGN_OR_RETURN(
      coarse.targets_,
      RenderTargets::Create(coarse.camera_.width, coarse.camera_.height, {.blended = blended}));
  coarse.values_ = Image<float>(coarse.camera_.width, coarse.camera_.height, 3);
  return coarse;
}

ImageTiles CoarseRatio::Draw(const ShadowRatioPass& pass, const SceneSurfaces& surfaces,
                             const SurfacePrograms& programs, const shadows::View& view,
                             const FrameUniforms& frame, const ImageTiles& wanted) {
  const shadows::View coarse_view = SeenBy(camera_, view);
  FrameUniforms coarse = frame;
  coarse.clip_from_marker = glm::mat4(coarse_view.ClipFromMarker());
  coarse.ray = RaysThroughPixels(camera_, coarse_view);
  const PixelRect whole{0, 0, camera_.width, camera_.height};
  EnableSurfaceTests();
  pass.DrawSurfaces(targets_, surfaces, coarse, whole);
  glDisable(GL_CULL_FACE);
  pass.DrawSky(targets_, surfaces, programs, coarse, whole);
  glDisable(GL_DEPTH_TEST);

  ratio().Download(GL_RGB, GL_FLOAT,
                   std::as_writable_bytes(std::span(values_.data(), values_.size())));
  return wanted.Where([&](const PixelRect& tile) { return HasJump(values_, tile); });
}

}  // namespace pleinair::compositor
