#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/project/new_scene.h"
#include "base/error.h"
#include "scene/trajectory_description.h"
#include "session/marker_tracks.h"

namespace pleinair::app {

/// What `pleinair new` makes a project from.
struct NewProjectRequest {
  /// One film; photographs for their tags. Without a film, the first photograph is composed.
  std::vector<std::filesystem::path> files;
  std::filesystem::path folder;
  std::optional<std::filesystem::path> calibration;
  std::optional<session::MarkerName> marker;
  StatedScene stated;
  /// Trajectory of the film that the scene names; its lens counts where it has one.
  std::optional<scene::TrajectoryDescription> trajectory{};
  bool replaces = false;  ///< An earlier project in the folder.
};

/// A new project.
struct NewProject {
  NewScene scene;
  std::int64_t first_picture_frame = 0;
  std::vector<std::string> warnings;  ///< About the first picture, one sentence each.
};

/// Makes a project: collects the scene from the files, composes the first picture and writes the
/// folder. `questions`: null where nobody can be asked. Errors: an unreadable file or model, no
/// marker in view, a value without a source, a folder that cannot be written. Errors
/// (system): no OpenGL 4.5; interrupted. After an error nothing was written.
Result<NewProject> MakeProject(const NewProjectRequest& request, Questions* questions);

}  // namespace pleinair::app
