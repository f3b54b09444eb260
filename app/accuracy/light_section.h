#pragma once

#include <string>

#include "app/accuracy/accuracy_json.h"

namespace pleinair::app {

/// Scores of the composited images: a table with intervals. For the worst key frames it shows
/// ground truth, our image and the difference. Empty without recordings that have ground-truth
/// images.
std::string LightSection(const AccuracyReport& report);

}  // namespace pleinair::app
