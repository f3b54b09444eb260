#pragma once

#include <string>

#include "app/replay/report/report.h"

namespace pleinair::app {

/// report.html: one page without any external resource: frames before and after, the camera's path
/// as plots, the light, times per stage, warnings. Follows the reader's light or dark mode.
std::string ReportHtml(const ReplayReport& report);

}  // namespace pleinair::app
