#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/frames.h"

namespace pleinair::content {

/// Part of a draped line between two vertices. It lies in one triangle of the surface, or climbs a
/// vertical face. A point feature is a segment with from == to.
struct DrapedSegment {
  Point<World> from, to;  ///< Metres.
  /// Arc length from the start of the line, along the draped line; what is left out has none.
  double from_arc_m = 0.0, to_arc_m = 0.0;
  std::uint32_t feature = 0;  ///< Number of the feature.
  /// First and last segment of a line or of a piece of one, for caps. The ends of a ring have none:
  /// they meet.
  bool starts = false, ends = false;
};

/// An area seen from above; its fill needs no triangles. Rings are closed and have the draped
/// vertices. Where no surface lies under a vertex, it has the height of the one before it.
struct DrapedArea {
  std::uint32_t feature = 0;
  std::vector<std::vector<Point<World>>> rings;
};

/// Counts of a drape, in vertices.
struct DrapeReport {
  std::size_t vertices_in = 0;   ///< Those of the file.
  std::size_t vertices_out = 0;  ///< Those of the draped lines.
  /// Vertices of the file over no surface. Where a line crosses a gap between two vertices, the gap
  /// counts as one.
  std::size_t off_target = 0;
  std::size_t clipped = 0;  ///< Vertices of the file beyond the radius.
};

/// The features of a map on the surface, in the tangent frame of the place: east, north and up from
/// the origin of the marker.
struct DrapedLayer {
  std::vector<DrapedSegment> segments;  ///< Outlines of areas too; in the order of the features.
  std::vector<DrapedArea> areas;
  DrapeReport report;
};

}  // namespace pleinair::content
