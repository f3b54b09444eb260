#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/image.h"

namespace pleinair::app {

/// The files of a new project, apart from the film.
struct ProjectFiles {
  std::string scene_toml, recording_json;
  RgbImage first_picture;  ///< first.png
};

/// Checks that a project can be written to `folder`, without touching the disk. Errors (input): not
/// a folder; no permission; a project or a recording is there. With `replaces`, an earlier project
/// of 'pleinair new' may be there.
Result<void> CheckProjectFolder(const std::filesystem::path& folder, bool replaces);

/// Writes all files, or none: after an error, files and folders that were created are removed.
/// Errors: CheckProjectFolder(); disk full (system).
Result<void> WriteProject(const ProjectFiles& files, const std::filesystem::path& folder,
                          bool replaces);

}  // namespace pleinair::app
