#pragma once

#include <optional>

#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Extracts the foliage of a phantom's open surface as a surface of its own. Returns nothing if the
/// surface has no foliage or is closed. Positions are in metres, marker coordinates.
///
/// A reconstructed tree has about the right outline, but its leaves match the real ones neither in
/// place nor in number. Only the image shows the pattern of sun and shadow below it. Foliage
/// therefore occludes what is behind it but casts no shadow, which would be a guess.
///
/// A leaf is a connected piece whose bounding box has no side longer than 0.5 m. Leaves count as
/// foliage if there are at least 50. They must spread in all three directions by more than half
/// their size, and face other ways than their neighbours. Hedges and crowns of leaves or alpha
/// cards are foliage. Grass blades on one lawn, links of a fence, tiles, slabs and bricks are not.
std::optional<SurfaceMesh> ExtractFoliage(SurfaceMesh* surface);

}  // namespace pleinair::compositor
