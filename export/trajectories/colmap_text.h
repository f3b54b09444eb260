#pragma once

#include <string>

#include "export/trajectories/colmap_model.h"

namespace pleinair::exports {

/// A sparse model in COLMAP's text form: camera-from-world, quaternion w first. `folder` is the
/// model's, for errors, which say file and line.
/// Errors: files cut short, numbers that are not finite, quaternions that are no rotation, camera
/// models of other formulae.
Result<ColmapModel> ParseColmapText(const ColmapFiles& files, const std::string& folder);

/// The model as text, numbers to twelve digits.
ColmapFiles ColmapText(const ColmapModel& model);

}  // namespace pleinair::exports
