#pragma once

#include <filesystem>
#include <optional>

#include "app/check/site_findings.h"
#include "base/error.h"

namespace pleinair::app {

/// The recording to check.
struct CheckRequest {
  std::filesystem::path project;
  std::optional<std::filesystem::path> scene, calibration;  ///< As for replay.
};

/// Measures up to 24 frames, 96 with a trajectory, spread over a recording, and collects the input
/// of JudgeSite(). Near those that show the marker, up to 24 more are tracked, which align a
/// trajectory. Errors: those of OpenRecording(), Pipeline::Create() and the passes; a recording
/// without a scene; interrupted.
Result<SiteFacts> LookAtSite(const CheckRequest& request);

}  // namespace pleinair::app
