#pragma once

#include <optional>
#include <span>
#include <vector>

#include "content/draping/drape_lines.h"
#include "content/draping/surface_view.h"

namespace pleinair::content {

/// Bounds of heights of a surface, metres.
struct HeightRange {
  double low_m = 0.0, high_m = 0.0;
};
HeightRange HeightsOf(const SurfaceIndex& surface);

/// Where the vertical line of a place meets the surface as the camera sees it.
struct ScreenHeight {
  double height_m = 0.0;
  /// Another surface seems to stand before the place; the height is that one's. Some 10 % of the
  /// places near a silhouette are flagged although they are seen.
  bool hidden = false;
};

/// Searches the height of a place on the screen: Trapp and Döllner 2019, listing 1, with these
/// deviations. The line from `range`, 1 m longer at both ends, is clipped to the picture and to the
/// near plane, in metres. A point of the line is above the surface if it is nearer to the camera
/// than what its pixel sees: both lie on one ray. The paper compares the depths of two points of
/// the vertical line, which for a level camera are equal. Bisection ends within half a pixel, or
/// after 32 steps; one secant step follows. A place is flagged as hidden if the surface found lies
/// more than two pixels, without their stretch by a grazing view, and 2 cm beside it.
///
/// Unset: the line is not in the picture, or the sky is behind all of it.
std::optional<ScreenHeight> SearchScreen(const SurfaceView& view, Vec2 east_north,
                                         const HeightRange& range);

/// Lines whose vertices have heights of the screen search, and what it could not see.
struct ScreenDrape {
  DrapedPieces draped;
  std::vector<std::vector<bool>> hidden;  ///< For each piece and vertex.
};

/// Drapes the vertices of the file on the surface as the camera sees it; it adds none. Those
/// flagged as hidden, and those outside the picture, have the height of the exact path, from where
/// a ray to the camera decides. Lines are broken at vertices over no surface. `options.on` must not
/// be kLowest, which no camera sees.
ScreenDrape DrapeOnScreen(std::span<const LineToDrape> lines, const SurfaceView& view,
                          const SurfaceIndex& surface, const DrapeOptions& options);

}  // namespace pleinair::content
