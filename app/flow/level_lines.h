#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "content/flow/flow_line.h"
#include "content/flow/line_integrator.h"
#include "content/flow/vector_field.h"

namespace pleinair::app {

/// Lines whose vertices come from levels.
struct LevelLines {
  std::vector<content::FlowLine> lines;
  std::uint64_t field_reads = 0;  ///< Of the levels.
  int levels = 0;                 ///< Doublings; twice as many both ways.
  double build_ms = 0.0;
};

/// A vertex after each of 0…`steps` steps of `options.step_s`, each way. A line ends where it
/// leaves. Errors (input): those of the levels.
Result<LevelLines> FollowLevels(const content::VectorField& field,
                                std::span<const content::Seed> seeds,
                                const content::TraceOptions& options, int steps, bool nearest);

}  // namespace pleinair::app
