#pragma once

#include <span>

#include "base/image.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// What the virtual image shows behind its nearest surfaces, where these hide others: as the
/// members of PinholeImage. Empty: nothing is hidden.
struct HiddenImage {
  Image<float> ratio, objects, dioptres;
};

/// The virtual image without a lens, by pixel of the render image, as a lens needs it.
struct PinholeImage {
  Image<float> ratio;    ///< RenderTargets::ratio(), 4 channels.
  Image<float> objects;  ///< RenderTargets::objects(), 4 channels.
  /// The same as if there were no real surfaces. Empty: real surfaces hide no object.
  Image<float> objects_alone;
  /// 1/z of what a pixel shows, 1/m, by Surface: 0 where there is none, or it is not known.
  Image<float> dioptres;
  /// The nearest object's part of all objects in a pixel, and 1/z of the farthest, 1/m.
  Image<float> object_parts;

  /// Channels of `dioptres`. kNearestPart: of the real surfaces, the part that the nearest has.
  enum Surface { kObject = 0, kNearestReal = 1, kNearestPart = 2, kFarthestReal = 3 };
};

/// Smallest and largest reciprocal distance, 1/m. `min` is the larger one without any.
struct DioptreRange {
  float min = 1e30F, max = -1e30F;
};

/// 1/z of a real surface that ends at a pixel before an object. 0: there is none. The object may be
/// in the pixel, or in the one to the left or above.
float OccluderEdge(const PinholeImage& image, int x, int y);

/// Returns the range of all that virtual objects affect noticeably, and of what covers them.
DioptreRange AffectedDioptres(const PinholeImage& image, std::span<const PixelRect> within);

/// The virtual image that a lens makes of it.
struct LensImage {
  Image<float> ratio, objects;  ///< As those of PinholeImage.
  /// Share of the lens that shows a real surface in front of objects, one channel.
  Image<float> occluder_share;
};

}  // namespace pleinair::compositor
