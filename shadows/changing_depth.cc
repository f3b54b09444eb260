#include "shadows/changing_depth.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace pleinair::shadows {

TexelRect ChangingDepth::Draw(const std::vector<ChangingCaster>& casters, bool still_is_new,
                              int side, int layer, const gl::GlTexture& depth) {
  if (still_is_new) {
    still_ = {};
    covered_ = {};
    casters_.clear();
  }
  if (casters == casters_) return {};
  casters_ = casters;
  if (still_.empty()) {
    still_ = Image<float>(side, side);
    glGetTextureSubImage(depth.id(), 0, 0, 0, layer, side, side, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                         static_cast<GLsizei>(still_.size() * sizeof(float)), still_.data());
    drawn_ = still_;
  }
  TexelRect covered;
  std::vector<DepthRaster> rasters;
  rasters.reserve(casters.size());
  for (const ChangingCaster& caster : casters) {
    rasters.emplace_back(caster.triangles, caster.texel_from_model, side);
    covered = covered.UnitedWith(rasters.back().bounds());
  }
  const TexelRect changed = covered.UnitedWith(covered_);
  covered_ = covered;
  if (changed.Empty()) return {};
  for (int y = changed.y0; y < changed.y1; ++y) {
    std::copy_n(&still_(changed.x0, y), changed.width(), &drawn_(changed.x0, y));
  }
  for (const DepthRaster& raster : rasters) raster.Draw(&drawn_);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, side);
  glTextureSubImage3D(depth.id(), 0, changed.x0, changed.y0, layer, changed.width(),
                      changed.height(), 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                      &drawn_(changed.x0, changed.y0));
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  return changed;
}

}  // namespace pleinair::shadows
