#pragma once

#include <span>

#include "content/draping/drape_lines.h"

namespace pleinair::content {

/// The largest vertical distance between draped lines, less their height above it, and the surface
/// below them, metres. The middle of each segment counts, and up to 14 places beside it in long
/// ones; vertical segments do not.
double MaxChordError(std::span<const LineToDrape> lines, const DrapedPieces& draped,
                     const SurfaceIndex& surface, const SurfaceRule& rule);

}  // namespace pleinair::content
