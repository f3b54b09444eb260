#include "app/project/new_project.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <iostream>
#include <optional>
#include <utility>

#include "app/project/first_picture.h"
#include "app/project/lens_of_film.h"
#include "app/project/project_folder.h"
#include "app/project/scene_text.h"
#include "app/replay/given_trajectory.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/interrupt_deadline.h"
#include "devices/calibration/calibration.h"
#include "devices/images/image_file.h"
#include "scene/scene_facts.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

/// Phones also write photographs that cannot be read.
Result<void> CheckIsNoRawPhoto(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".heic" && ending != ".heif" && ending != ".dng") return {};
  return InputError(file.string(), "is a photograph, but no JPEG",
                    "export it as JPEG, with its tags");
}

/// The composed file first.
Result<std::vector<fs::path>> InOrder(const std::vector<fs::path>& files) {
  std::vector<fs::path> films, photos;
  for (const fs::path& file : files) {
    std::error_code error;
    if (!fs::exists(file, error)) {
      return InputError(file.string(), "does not exist", "check the name");
    }
    if (fs::is_directory(file, error)) {
      return InputError(file.string(), "is a folder",
                        "name a film or a photograph; 'pleinair replay' composes recordings");
    }
    PLEINAIR_RETURN_IF_ERROR(CheckIsNoRawPhoto(file));
    (devices::IsImageFile(file) ? photos : films).push_back(file);
  }
  if (films.size() > 1) {
    return InputError(films[1].string(), "is a second film",
                      "make one project for each film; photographs may be added to it");
  }
  films.insert(films.end(), photos.begin(), photos.end());
  return films;
}

/// Name of a file or a folder, also of "scan/".
std::string NameOfTrajectory(const fs::path& file) {
  return (file.has_filename() ? file : file.parent_path()).filename().string();
}

/// The lens of the film, before it is scaled and turned; nothing: to be assumed. Errors: an
/// unreadable calibration, trajectory or film.
Result<std::optional<KnownLens>> LensOf(const NewProjectRequest& request, const fs::path& film) {
  std::optional<CameraModel> by_trajectory;
  if (request.trajectory) {
    PLEINAIR_ASSIGN_OR_RETURN(const exports::CameraTrajectory path,
                              ReadTrajectoryFile(*request.trajectory));
    if (request.trajectory->turn_deg == 0) by_trajectory = path.camera;
  }
  if (request.calibration) {
    PLEINAIR_ASSIGN_OR_RETURN(CameraModel camera, devices::ReadCalibration(*request.calibration));
    return KnownLens{camera, request.calibration->string()};
  }
  if (by_trajectory) {
    return KnownLens{
        *by_trajectory, "the trajectory " + NameOfTrajectory(request.trajectory->file), {}, true};
  }
  if (devices::IsImageFile(film)) return std::nullopt;
  return LensOfFilm(film, FamiliesToLookFor(request.marker ? std::optional(request.marker->family)
                                                           : std::nullopt));
}

/// Reports what nobody has stated before the search for markers, which takes seconds. On a terminal
/// it is asked for after the search.
Result<void> CheckBeforeSearch(const std::vector<fs::path>& files, const StatedScene& stated) {
  std::vector<FilmLook> sources;
  sources.reserve(files.size());
  for (const fs::path& file : files) {
    PLEINAIR_ASSIGN_OR_RETURN(FilmLook tags, ReadTags(file));
    sources.push_back(std::move(tags));
  }
  return CheckNothingIsMissing(sources, stated);
}

Result<Footage> LookAtAll(const NewProjectRequest& request, const std::vector<fs::path>& files) {
  LookOptions options;
  if (request.marker) options.family = request.marker->family;
  options.is_marker_rare = request.trajectory.has_value();
  PLEINAIR_ASSIGN_OR_RETURN(options.lens, LensOf(request, files.front()));
  Footage footage;
  PLEINAIR_ASSIGN_OR_RETURN(footage.film, LookAt(files.front(), options));
  const auto marker = ChooseMarker(footage.film, request.marker);
  if (!marker) {
    const std::string name = request.marker ? "marker " + request.marker->ToString() : "marker";
    return InputError(
        files.front().string(),
        fmt::format("shows no {} in {} frames spread over it", name, footage.film.looked_at.size()),
        "film it sharp, flat, larger than 16 pixels and with its white margin "
        "(docs/guide/troubleshoot.md)");
  }
  footage.marker = *marker;
  footage.marker.is_stated = request.marker.has_value();
  // A photograph has another lens than a film.
  options.lens.reset();
  for (std::size_t i = 1; i < files.size(); ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(FilmLook photo, LookAt(files[i], options));
    footage.photos.push_back(std::move(photo));
  }
  return footage;
}

/// Reads the new scene as replay will.
Result<scene::SceneDescription> Understand(const std::string& toml, const fs::path& folder) {
  const fs::path file = fs::absolute(folder).lexically_normal() / "scene.toml";
  PLEINAIR_ASSIGN_OR_RETURN(const scene::SceneFacts facts,
                            scene::ParseSceneToml(toml, file.string()));
  return scene::CompleteScene(facts, file);
}

}  // namespace

Result<NewProject> MakeProject(const NewProjectRequest& request, Questions* questions) {
  PLEINAIR_RETURN_IF_ERROR(CheckProjectFolder(request.folder, request.replaces));
  std::error_code error;
  if (request.stated.model && !fs::is_regular_file(*request.stated.model, error)) {
    return InputError(request.stated.model->string(), "is no file", "check the name of the model");
  }
  const InterruptGuard guard;
  std::optional<InterruptDeadline> deadline(std::in_place, request.folder.string(), [] {});
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<fs::path> sources, InOrder(request.files));
  if (questions == nullptr) {
    PLEINAIR_RETURN_IF_ERROR(CheckBeforeSearch(sources, request.stated));
  }
  PLEINAIR_ASSIGN_OR_RETURN(const Footage footage, LookAtAll(request, sources));
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(request.folder.string()));
  deadline.reset();
  if (questions != nullptr) {
    // An answer is waited for on the terminal's last line.
    deadline.emplace(
        request.folder.string(), [] { std::cerr << '\n'; }, "nothing was written",
        std::chrono::milliseconds(0));
  }
  PLEINAIR_ASSIGN_OR_RETURN(NewScene scene, CollectScene(footage, request.stated, questions));
  ProjectFiles files;
  PLEINAIR_ASSIGN_OR_RETURN(files.scene_toml, NewSceneToml(scene, request.folder));
  if (request.trajectory) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::string table,
                              NewTrajectoryToml(*request.trajectory, request.folder));
    files.scene_toml += table;
  }
  PLEINAIR_ASSIGN_OR_RETURN(files.recording_json,
                            NewRecordingJson(footage.film.file, footage.film.lens, request.folder));
  PLEINAIR_ASSIGN_OR_RETURN(const scene::SceneDescription description,
                            Understand(files.scene_toml, request.folder));
  deadline.emplace(request.folder.string(), [] {});
  PLEINAIR_ASSIGN_OR_RETURN(
      FirstPicture picture,
      ComposeFirstPicture(footage.film, footage.marker.best_frame, description));
  deadline.reset();  // The project's files appear together.
  files.first_picture = std::move(picture.image);
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(request.folder.string()));
  PLEINAIR_RETURN_IF_ERROR(WriteProject(files, request.folder, request.replaces));
  const std::string& note = footage.film.lens.note;
  if (!note.empty()) picture.warnings.insert(picture.warnings.begin(), note);
  return NewProject{std::move(scene), footage.marker.best_frame, std::move(picture.warnings)};
}

}  // namespace pleinair::app
