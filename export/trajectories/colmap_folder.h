#pragma once

#include <array>
#include <filesystem>

#include "base/error.h"
#include "export/trajectories/colmap_model.h"

namespace pleinair::exports {

/// COLMAP's file formats of a model: `.txt` or `.bin`.
enum class ColmapForm { kText, kBinary };

/// File names of a model, in writing order: images last, which completes the model.
std::array<const char*, 3> ColmapFileNames(ColmapForm form);

/// Reads a model in either format. If a folder contains both, the choice is COLMAP's: binary if all
/// binary files exist. Errors: as the parsers; files that are missing or larger than 1 GiB.
Result<ColmapModel> ReadColmapFolder(const std::filesystem::path& folder);

/// Writes a model, each file under a temporary name first. Creates the folder. Errors: it contains
/// a model in the other format, which would contradict this one.
Result<void> WriteColmapFolder(const ColmapModel& model, ColmapForm form,
                               const std::filesystem::path& folder);

}  // namespace pleinair::exports
