#include "app/live/scene_file.h"

#include <system_error>
#include <utility>

#include "app/live/live_recorder.h"
#include "base/atomic_file.h"
#include "files/text_file.h"
#include "scene/scene_facts.h"
#include "session/scene_saving.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

/// The folder of a file, without links and dots.
fs::path FolderOf(const fs::path& file) {
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(file, error);
  return (error ? file : whole).parent_path();
}

}  // namespace

Result<SceneFile> SceneFile::Open(const scene::SceneDescription& scene,
                                  const session::SceneEdit& unedited, const fs::path& target) {
  SceneFile file;
  file.scene_ = scene;
  file.saved_ = unedited;
  std::error_code error;
  auto text = files::ReadWholeFile(scene.file, files::kMaxDescriptionBytes);
  const bool is_toml = text && scene::ParseSceneToml(*text, scene.file.string());
  if (target.empty()) {
    if (!is_toml) return file;
    // A link stays a link: its target is written.
    const fs::path whole = fs::canonical(scene.file, error);
    file.path_ = error ? scene.file : whole;
    file.text_ = *std::move(text);
    file.on_disk_ = file.text_;
    return file;
  }
  if (fs::exists(fs::symlink_status(target, error))) {
    return InputError("--save-scene", target.string() + " exists already",
                      "name a new file, or leave the option out to save into the scene's own");
  }
  if (is_toml && FolderOf(target) != FolderOf(scene.file)) {
    return InputError("--save-scene",
                      target.string() + " is not in the folder of " + scene.file.string() +
                          ", where its models are",
                      "name a file in that folder");
  }
  file.path_ = target;
  file.text_ =
      is_toml ? *std::move(text) : SceneToml(scene, scene.place_time.start, FolderOf(target));
  return file;
}

Result<void> SceneFile::CheckUnchanged() const {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path_, error))) return {};
  const auto now = files::ReadWholeFile(path_, files::kMaxDescriptionBytes);
  if (now && on_disk_ && *now == *on_disk_) return {};
  return InputError(path_.string(), "was changed by another program since it was read",
                    "nothing was saved: start again, with --save-scene FILE to keep both");
}

Result<fs::path> SceneFile::Save(const session::SceneEdit& edit) {
  if (path_.empty()) {
    return InputError(scene_.file.string(), "is not a scene.toml, so it is not written",
                      "start with --save-scene FILE, a new scene.toml");
  }
  PLEINAIR_RETURN_IF_ERROR(CheckUnchanged());
  PLEINAIR_ASSIGN_OR_RETURN(std::string text, session::WithSavedEdit(text_, scene_, saved_, edit));
  if (on_disk_ != text) PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(path_, text));
  on_disk_ = text;
  text_ = std::move(text);
  saved_ = edit;
  return path_;
}

bool SceneFile::IsUnsaved(const session::SceneEdit& edit) const {
  return session::ChangesScene(saved_, edit);
}

}  // namespace pleinair::app
