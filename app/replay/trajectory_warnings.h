#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/trajectory/follow_trajectory.h"

namespace pleinair::app {

/// Returns sentences on a given trajectory for the report: what the poses rest on, and the offset
/// of its clock. Also where it disagrees with the marker, and frames that it does not cover.
std::vector<std::string> TrajectoryWarnings(const session::TrajectorySummary& summary);

/// True if trajectory and marker are farther apart than three standard deviations of the corners.
bool DisagreesWithMarker(const session::TrajectorySummary& summary);

/// True if the trajectory's vertical is farther from the scene's than sloping ground explains.
bool HasTiltedMarker(const session::TrajectorySummary& summary);

}  // namespace pleinair::app
