#pragma once

#include <string>

#include "app/live/live_report.h"
#include "app/live/live_statistics.h"

namespace pleinair::devices {
class LiveCamera;
}

namespace pleinair::app {

// What `pleinair live` says: JSON lines on standard output, or words on standard error.

/// Tells what the camera has reported since the last call; gives the last of it in words. Nothing
/// where it is null.
std::string ReportEvents(devices::LiveCamera* camera, bool json);

/// What became of the controls that were asked of the camera.
void ReportControls(const devices::LiveCamera* camera);

void Report(const LiveInterval& interval, bool json);

/// At the end of a session.
void Report(const LiveStatistics& statistics, bool json);

}  // namespace pleinair::app
