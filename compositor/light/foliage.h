#pragma once

#include <optional>

#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// Takes the loose leaves out of an open surface of a phantom, as a surface of their own; nothing
/// where it has none, or is closed. Positions are metres, marker coordinates.
///
/// A tree that was reconstructed has about the right outline, but its leaves are not where the real
/// ones are, nor as many: the pattern of sun and shade below it is in the picture alone. Such
/// leaves hide what stands behind them, but what shade they cast would be a guess.
///
/// Leaves are pieces of up to 0.5 m (the longest side of its box) that touch nothing else of their
/// surface, where there are 50 of them or more, these lie about in all three directions, farther
/// than half their size, and face other ways than those next to them. So a hedge, a crown of leaves
/// or of cards is taken; blades that stand on one lawn, a fence's links, tiles, slabs and bricks
/// are not.
std::optional<SurfaceMesh> ExtractFoliage(SurfaceMesh* surface);

}  // namespace pleinair::compositor
