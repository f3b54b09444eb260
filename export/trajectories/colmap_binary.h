#pragma once

#include <string>

#include "export/trajectories/colmap_model.h"

namespace pleinair::exports {

/// Parses a sparse model in COLMAP's binary format (its docs, "Output Format", and
/// scene/reconstruction_io.cc), as written by its mapper and model_converter. `folder` is the
/// model's; errors name it with file and entry. Errors: as ParseColmapText, and bytes after the
/// last entry.
Result<ColmapModel> ParseColmapBinary(const ColmapFiles& files, const std::string& folder);

/// Formats the model in binary, with exact numbers.
ColmapFiles ColmapBinary(const ColmapModel& model);

}  // namespace pleinair::exports
