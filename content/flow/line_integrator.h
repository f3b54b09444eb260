#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "base/error.h"
#include "content/flow/flow_line.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

enum class LineKind {
  kStream,  ///< Tangent to the velocities of one moment.
  kPath,    ///< The way of a particle.
  kStreak,  ///< The particles that passed the seed, at the end of the duration.
};

enum class LineDirection { kForward, kBackward, kBoth };

struct TraceOptions {
  LineKind kind = LineKind::kStream;
  LineDirection direction = LineDirection::kForward;
  double tolerance_cells = 1e-3;  ///< Of the position, absolute.
  double length_m = 0.0;          ///< The most, each way; 0: 4 diagonals of the domain.
  /// The most, each way. Streaklines need it where the field is steady.
  Seconds duration_s = std::numeric_limits<double>::infinity();
  Seconds frozen_at_s = 0.0;  ///< The moment of streamlines.
  /// Vertices at its multiples, and particles of streaklines in this interval. 0: vertices at the
  /// steps of the integration, 128 particles.
  Seconds step_s = 0.0;
  int threads = 0;                      ///< 0: one for each processor.
  std::function<void()> progress = {};  ///< Called for each seed, by one thread at a time.
};

/// Lines from seeds, in their order. A seed without flow, or whose line has a single vertex, has
/// none. Both ways: vertices run downstream. Method: Dormand and Prince 1980, order 5(4), with
/// dense output of order 4; steps of at most half a cell. Pathlines end with the times of the
/// field. The result does not depend on the number of threads. Errors (input): those of reading;
/// streaklines of a steady field without a duration.
Result<std::vector<FlowLine>> TraceLines(const VectorField& field, std::span<const Seed> seeds,
                                         const TraceOptions& options);

/// The length that options ask for, metres.
double LengthOf(const VectorField& field, const TraceOptions& options);

}  // namespace pleinair::content
