#pragma once

#include <string>

#include "export/trajectories/colmap_model.h"

namespace pleinair::exports {

/// Parses a sparse model in COLMAP's text format: camera-from-world, quaternion w first. `folder`
/// is the model's; errors name it with file and line. Errors: truncated files, numbers that are not
/// finite, quaternions that are not rotations, unsupported camera models.
Result<ColmapModel> ParseColmapText(const ColmapFiles& files, const std::string& folder);

/// Formats the model as text, with twelve digits per number.
ColmapFiles ColmapText(const ColmapModel& model);

}  // namespace pleinair::exports
