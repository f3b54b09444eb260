#pragma once

#include <vector>

#include "base/error.h"
#include "content/flow/flow_line.h"
#include "content/flow/line_integrator.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// Streamlines at even distances, without seeds from the user (Jobard, Lefer 1997). A line starts
/// where no other is nearer than `spacing_m`, and goes both ways until one, or itself, is nearer
/// than half of that. Each vertex of a line proposes seeds beside it, in the plane to either side,
/// in space to four. At the end, the largest holes give seeds. Lines shorter than the spacing are
/// left out unless they are closed. The same lines for any number of threads. Errors (input): those
/// of TraceLines(); a spacing that is not positive or too small for the domain.
Result<std::vector<FlowLine>> PlaceLines(const VectorField& field, double spacing_m,
                                         const TraceOptions& options);

/// How even lines are.
struct LineSpacing {
  double nearest_min_m = 0.0;  ///< Between vertices of different lines; 0: fewer than two lines.
  double covered = 0.0;        ///< Share of the cells with flow within one spacing of a line.
};

LineSpacing MeasureSpacing(const VectorField& field, Seconds frozen_s,
                           const std::vector<FlowLine>& lines, double spacing_m);

}  // namespace pleinair::content
