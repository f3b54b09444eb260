#pragma once

// Internal: particles that move through the times of a field together.

#include <functional>
#include <vector>

#include "base/error.h"
#include "content/flow/line_tracer.h"

namespace pleinair::content {

/// A particle from its seed at its time until `stop_s`, or on from there.
struct MovingParticle {
  Seed seed;
  Seconds stop_s = 0.0;
  bool keeps_vertices = false;  ///< Else only its last place.
  LineState line;
  LineVertices vertices;
  bool begun = false;                ///< False: no flow at its seed.
  LineEnd end = LineEnd::kDuration;  ///< kDuration: it got to `stop_s`.
  double speed_m_s = 0.0;            ///< At its last place.
};

/// Moves all particles, downstream for a positive sign. They pass the times of the field one after
/// the other, so that two times at once are in memory. Steps end at each time: the field has a
/// kink there. Errors: those of reading.
Result<void> MoveParticles(const VectorField& field, double sign, int threads,
                           const std::function<LineLimits(const FieldWindow&)>& limits,
                           std::vector<MovingParticle>* particles);

}  // namespace pleinair::content
