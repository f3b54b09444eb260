#pragma once

#include <vector>

#include "base/image.h"
#include "gl/texture.h"
#include "shadows/depth_raster.h"

namespace pleinair::shadows {

/// The pyramid of minimum and maximum depth of shaders/shadow_bounds.frag, made on the processor
/// where casters change. A software renderer of OpenGL would spend most of the time between the
/// small levels.
class DepthBounds {
 public:
  /// Brings those texels of one layer of `bounds` up to date that show the `changed` ones of
  /// `depths`. At the first call and after Forget() these are all. `levels`: of the pyramid.
  void Update(const Image<float>& depths, const TexelRect& changed, int levels, int layer,
              const gl::GlTexture& bounds);
  /// Depths have changed elsewhere.
  void Forget() { levels_.clear(); }

 private:
  std::vector<Image<float>> levels_;  // Minimum and maximum; from 4×4 texels on.
};

}  // namespace pleinair::shadows
