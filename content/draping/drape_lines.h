#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "content/draping/draped_layer.h"
#include "content/draping/surface_index.h"
#include "content/georeference/vector_layer.h"

namespace pleinair::content {

/// A point, line or ring of a feature before it is draped. A ring repeats its first vertex.
struct LineToDrape {
  std::uint32_t feature = 0;
  PartKind kind = PartKind::kLine;
  std::vector<Point<World>> points;
  double above_m = 0.0;  ///< Height above the surface, along the vertical.
};

struct DrapeOptions {
  SurfaceRule on = {};
  double radius_m = 2000.0;  ///< What is farther from the marker is cut off. Horizontal.
  /// The lines keep their own heights, plus `above_m`; no surface is needed.
  bool own_heights = false;
  int threads = 0;  ///< 0: one per processor. The result does not depend on it.
};

struct DrapedVertex {
  Point<World> at;
  bool of_file = false;  ///< A vertex of the file. False: a crossed edge, a wall, or the radius.
};

/// A piece of a draped line without a break.
struct DrapedPiece {
  std::size_t line = 0;  ///< Index of the line.
  std::vector<DrapedVertex> vertices;
  bool starts = true, ends = true;  ///< False: it continues where a ring closes.
};

/// Lines as they are draped, and the rings of areas.
struct DrapedPieces {
  std::vector<DrapedPiece> pieces;  ///< In the order of the lines.
  /// For each line that is a ring: its vertices, also those that lie over no surface.
  std::vector<std::vector<Point<World>>> rings;
  DrapeReport report;
};

/// Drapes lines on a surface. Between two vertices of the file, a line is straight as seen from
/// above and lies in the surface: it gets a vertex at every edge of a triangle that it crosses, so
/// that its distance from the surface is that of rounding. Where the height jumps at a vertical
/// face, it climbs the face. Where there is no surface, or the height jumps without a face, it is
/// broken.
DrapedPieces DrapeLines(std::span<const LineToDrape> lines, const SurfaceIndex& surface,
                        const DrapeOptions& options);

/// Segments with arc lengths, and areas.
DrapedLayer LayerOf(std::span<const LineToDrape> lines, const DrapedPieces& draped);

/// DrapeLines() and LayerOf(). Error (input): no line meets the surface and no area covers it.
/// `where` names the file.
Result<DrapedLayer> DrapeExactly(std::span<const LineToDrape> lines, const SurfaceIndex& surface,
                                 const DrapeOptions& options, const std::string& where);

/// The error of DrapeExactly(), for callers that need the pieces.
Result<void> CheckOnTarget(std::span<const LineToDrape> lines, const DrapedPieces& draped,
                           const SurfaceIndex& surface, const std::string& where);

}  // namespace pleinair::content
