#pragma once

#include "app/check/site_findings.h"

namespace pleinair::app {

/// Judges the scene's time and heading by the shadows of its described surfaces.
SiteFinding HeadingFinding(const SiteFacts& facts);

/// Judges the scene's cloudiness by the light estimate.
SiteFinding SkyFinding(const SiteFacts& facts);

}  // namespace pleinair::app
