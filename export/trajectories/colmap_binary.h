#pragma once

#include <string>

#include "export/trajectories/colmap_model.h"

namespace pleinair::exports {

/// A sparse model in COLMAP's binary form, as its mapper and model_converter write it (its docs,
/// "Output Format", and scene/reconstruction_io.cc). `folder` is the model's, for errors, which say
/// file and entry.
/// Errors: as ParseColmapText, and bytes behind the last entry.
Result<ColmapModel> ParseColmapBinary(const ColmapFiles& files, const std::string& folder);

/// The model in binary, numbers as they are.
ColmapFiles ColmapBinary(const ColmapModel& model);

}  // namespace pleinair::exports
