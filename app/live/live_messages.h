#pragma once

#include <string>

#include "app/live/live_report.h"
#include "app/live/live_statistics.h"
#include "app/live/live_trajectory.h"

namespace pleinair::devices {
class LiveCamera;
}

namespace pleinair::app {

// Messages of `pleinair live`: JSON lines on standard output, or text on standard error.

/// Reports the camera events since the last call and returns the last one as text. Does nothing if
/// `camera` is null.
std::string ReportEvents(devices::LiveCamera* camera, bool json);

/// Reports how the scene's trajectory is aligned, once that is known, and returns it as text. Does
/// nothing if `trajectory` is null.
std::string ReportNews(LiveTrajectory* trajectory, bool json);

/// Reports the result of each requested camera control.
void ReportControls(const devices::LiveCamera* camera);

void Report(const LiveInterval& interval, bool json);

/// Reports the totals at the end of a session.
void Report(const LiveStatistics& statistics, bool json);

}  // namespace pleinair::app
