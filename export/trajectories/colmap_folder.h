#pragma once

#include <array>
#include <filesystem>

#include "base/error.h"
#include "export/trajectories/colmap_model.h"

namespace pleinair::exports {

/// In which of COLMAP's forms a model's files are: `.txt` or `.bin`.
enum class ColmapForm { kText, kBinary };

/// What a model's files are called, in the order they are written: images last, which makes it one.
std::array<const char*, 3> ColmapFileNames(ColmapForm form);

/// Reads a model in either form; where a folder holds both, the one that COLMAP itself takes, which
/// is the binary one if all its files are there.
/// Errors: what the parsers refuse, files that are not there or larger than 1 GiB.
Result<ColmapModel> ReadColmapFolder(const std::filesystem::path& folder);

/// Writes a model, each file under a temporary name first. The folder is made.
/// Errors: it holds a model in the other form, which would contradict this one.
Result<void> WriteColmapFolder(const ColmapModel& model, ColmapForm form,
                               const std::filesystem::path& folder);

}  // namespace pleinair::exports
