#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "session/trajectory/given_trajectory.h"
#include "session/trajectory/trajectory_alignment.h"

namespace pleinair::session {

/// Aligns a trajectory by places: the closed form of Umeyama 1991 ("Least-squares estimation of
/// transformation parameters between two point patterns", Eqs. 40 to 42). `is_metric`: the scale
/// stays 1. The covariance takes the residuals as noise, at least 1 mm per coordinate. Errors:
/// fewer than three pairs, places on a line. They name `file`.
Result<TrajectoryAlignment> AlignByPoints(const std::vector<PointPair>& pairs, bool is_metric,
                                          const std::string& file);

}  // namespace pleinair::session
