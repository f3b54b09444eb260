#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/trajectory/follow_trajectory.h"

namespace pleinair::app {

/// Returns sentences on a given trajectory for the report: what the poses rest on, and the offset
/// of its clock. Also where it disagrees with the marker, and frames that it does not cover.
std::vector<std::string> TrajectoryWarnings(const session::TrajectorySummary& summary);

/// The offset of the trajectory's clock, and what it rests on: "offset of its clock 0.020 s,
/// estimated within 0.003 s". Empty where frames are found by their numbers.
std::string ClockText(const session::TrajectorySummary& summary);

/// True if the offset is neither given nor estimated.
bool HasAssumedOffset(const session::TrajectorySummary& summary);

/// True if trajectory and marker are farther apart than three standard deviations of the corners.
bool DisagreesWithMarker(const session::TrajectorySummary& summary);

/// True if the trajectory's vertical is farther from the scene's than sloping ground explains.
bool HasTiltedMarker(const session::TrajectorySummary& summary);

}  // namespace pleinair::app
