#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/vector.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Why a line ends.
enum class LineEnd {
  kLeft,       ///< It reached the border of the field.
  kStagnated,  ///< Its speed was below 1e-6 of the field's largest for 10 steps.
  kLength,     ///< It has the length that was asked for.
  kClosed,     ///< It came back to its start, within 1e-2 of a cell and with the same heading.
  kWall,       ///< It reached a cell without velocities.
  kDuration,   ///< It has the duration that was asked for, or the field's times are over.
  kNeighbor,   ///< It came near another line, or itself: even placement alone.
};

/// Where a line starts.
struct Seed {
  Vec3 point;
  Seconds time = 0.0;  ///< Of pathlines and streaklines.
};

/// A line along the flow, with a velocity at each vertex.
struct FlowLine {
  std::size_t seed = 0;  ///< Number of its seed.
  std::vector<Vec3> points;
  /// Streamlines: the time that a particle takes from the seed, negative upstream. Pathlines: the
  /// time of the particle there. Streaklines: the time at which the particle was released.
  std::vector<Seconds> times_s;
  std::vector<double> speeds_m_s;
  std::optional<LineEnd> upstream_end;    ///< Set if the line was followed upstream.
  std::optional<LineEnd> downstream_end;  ///< Set if the line was followed downstream.
  std::uint64_t field_reads = 0;
};

}  // namespace pleinair::content
