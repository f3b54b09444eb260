#pragma once

// Internal: the first step of levels.

#include <cstdint>

#include "content/flow/field_probe.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// A particle after `step_s` of the steady state at `time`, by eight steps of Runge and Kutta's
/// method of order 4. Not a number: its path leaves the field.
Vec3 FirstStep(FieldProbe* probe, Vec3 point, Seconds time, double step_s,
               std::uint64_t* field_reads);

}  // namespace pleinair::content
