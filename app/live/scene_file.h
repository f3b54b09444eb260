#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// Saves the edits of a live session to a scene.toml (session/scene_saving.h).
class SceneFile {
 public:
  /// `target`: a new file; empty: the file of the scene, if that is a scene.toml. `unedited`: the
  /// edit that the scene is shown with at first. Errors (input): the new file exists; it is not in
  /// the folder of the scene.toml that it is made from, whose paths are relative.
  static Result<SceneFile> Open(const scene::SceneDescription& scene,
                                const session::SceneEdit& unedited,
                                const std::filesystem::path& target);

  /// Writes the changes since the last call, all of them or none; returns the file. After an error
  /// the file is unchanged. Errors: another program has changed the file since it was read. There
  /// is no scene.toml and no new file. A scene cannot hold the values. The folder cannot be
  /// written.
  Result<std::filesystem::path> Save(const session::SceneEdit& edit);

  /// True if the edit changes the scene since the last call of Save().
  bool IsUnsaved(const session::SceneEdit& edit) const;

 private:
  SceneFile() = default;
  Result<void> CheckUnchanged() const;

  scene::SceneDescription scene_;
  std::filesystem::path path_;          // Empty: there is no file to write.
  std::string text_;                    // With the edit that was saved last.
  std::optional<std::string> on_disk_;  // What the file should hold; nothing: it should not exist.
  session::SceneEdit saved_;
};

}  // namespace pleinair::app
