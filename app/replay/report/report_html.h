#pragma once

#include <string>

#include "app/replay/report/report.h"

namespace pleinair::app {

/// Returns report.html: one page without external resources. It shows frames before and after,
/// plots of the camera trajectory, the light, times per stage, and warnings. It follows the
/// reader's light or dark mode.
std::string ReportHtml(const ReplayReport& report);

}  // namespace pleinair::app
