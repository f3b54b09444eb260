#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/image.h"
#include "gl/texture.h"
#include "shadows/depth_raster.h"

namespace pleinair::shadows {

/// A caster of a map that often changes its shape.
struct ChangingCaster {
  TriangleSpan triangles;
  glm::dmat4 texel_from_model{1.0};  ///< As DepthRaster's.
  std::uint64_t revision = 0;        ///< Number of the positions' last change.

  bool operator==(const ChangingCaster& other) const {
    return triangles.positions.data() == other.triangles.positions.data() &&
           triangles.indices.size() == other.triangles.indices.size() &&
           texel_from_model == other.texel_from_model && revision == other.revision;
  }
};

/// Draws casters that change their shape often into a depth map of still casters. It keeps the
/// still depths in memory, so a new shape costs only the texels of its old and new bounds.
class ChangingDepth {
 public:
  /// Draws into the first `side` rows and columns of a layer of `depth`. `still_is_new`: the layer
  /// now has the still casters alone. Returns the texels that may have changed since the last call,
  /// besides those of new still casters.
  TexelRect Draw(const std::vector<ChangingCaster>& casters, bool still_is_new, int side, int layer,
                 const gl::GlTexture& depth);
  /// The depths of still and changing casters. Empty before changing ones were drawn.
  const Image<float>& depths() const { return drawn_; }

 private:
  Image<float> still_;  // Empty until it is needed.
  Image<float> drawn_;
  TexelRect covered_;  // Where changing casters may have been drawn.
  std::vector<ChangingCaster> casters_;
};

}  // namespace pleinair::shadows
