#pragma once

#include <string>
#include <string_view>

#include "app/sinks/report.h"

namespace pleinair::app {

/// report.html: one page without any external resource: frames before and after, the camera's path
/// as plots, the light, times per stage, warnings. Follows the reader's light or dark mode.
std::string ReportHtml(const ReplayReport& report);

/// Text made safe for HTML, in elements and in quoted attributes.
std::string EscapeHtml(std::string_view text);

/// RFC 4648 base 64.
std::string Base64(const std::vector<std::uint8_t>& bytes);

}  // namespace pleinair::app
