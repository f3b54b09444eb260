#include "app/replay/film_calibration.h"

#include <memory>
#include <system_error>
#include <utility>

#include "app/calibrate/film_lens.h"
#include "app/calibrate/picture_stream.h"
#include "app/replay/given_trajectory.h"
#include "base/atomic_file.h"
#include "devices/calibration/calibration_text.h"
#include "devices/calibration/fitted_camera.h"
#include "devices/images/image_file.h"
#include "devices/recordings/video_file.h"
#include "files/text_file.h"
#include "scene/scene_facts.h"

namespace pleinair::app {
namespace {

bool IsFilm(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && file.extension() != ".json" &&
         file.extension() != ".mcap" && !devices::IsImageFile(file);
}

/// The trajectory of the options, or of the scene file.
Result<std::optional<scene::TrajectoryDescription>> TrajectoryNamed(const ReplayOptions& options) {
  if (!options.trajectory.file.empty()) return options.trajectory;
  if (!options.scene) return std::nullopt;
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(*options.scene, files::kMaxDescriptionBytes));
  PLEINAIR_ASSIGN_OR_RETURN(scene::SceneFacts facts,
                            scene::ParseScene(bytes, options.scene->string()));
  return std::move(facts.trajectory);
}

/// Errors: the film has images of another shape than the lens; those of OpenVideo().
Result<void> CheckFits(const CameraModel& lens, const std::filesystem::path& film,
                       const std::string& from) {
  PLEINAIR_ASSIGN_OR_RETURN(const devices::OpenedVideo video, devices::OpenVideo(film, {}));
  auto fitted = devices::FitCamera(lens, video.size, video.facts.clockwise_deg, film.string());
  if (fitted) return {};
  return tl::make_unexpected(OtherLensThanTrajectorys(std::move(fitted).error(), from));
}

/// The lens with which a trajectory was estimated; nothing if it has none, or one of turned images.
Result<std::optional<FilmCalibration>> CalibrateFromTrajectory(const ReplayOptions& options,
                                                               const OutputFolder& folder) {
  PLEINAIR_ASSIGN_OR_RETURN(const auto trajectory, TrajectoryNamed(options));
  if (!trajectory || trajectory->turn_deg != 0) return std::nullopt;
  PLEINAIR_ASSIGN_OR_RETURN(const exports::CameraTrajectory path, ReadTrajectoryFile(*trajectory));
  if (!path.camera) return std::nullopt;
  const std::string from = "the trajectory " + trajectory->file.string();
  PLEINAIR_RETURN_IF_ERROR(CheckFits(*path.camera, options.recording, from));
  PLEINAIR_ASSIGN_OR_RETURN(const std::string text,
                            devices::CalibrationText(*path.camera, devices::CalibrationForm::kOwn));
  FilmCalibration calibration{
      folder.staging() / "camera_from_trajectory.json",
      "No calibration was given. The lens is that of " + from + " (camera_from_trajectory.json)."};
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(calibration.file, text));
  return calibration;
}

/// The families to look for: the scene's, or those that replay looks for.
Result<tracker::MarkerViewOptions> ViewsOfScene(const ReplayOptions& options) {
  tracker::MarkerViewOptions views;
  if (!options.scene) {
    return InputError(options.recording.string(), "has no scene",
                      "write one (docs/guide/reference/recordings.md) and give it with --scene");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::string bytes,
                            files::ReadWholeFile(*options.scene, files::kMaxDescriptionBytes));
  PLEINAIR_ASSIGN_OR_RETURN(const scene::SceneFacts facts,
                            scene::ParseScene(bytes, options.scene->string()));
  if (facts.marker.target) {
    return InputError(options.recording.string(),
                      "has no lens calibration, and an image target does not give one",
                      "calibrate with a board (pleinair board), and give --calibration FILE");
  }
  if (facts.marker.family) views.families = {*facts.marker.family};
  return views;
}

}  // namespace

Result<std::optional<FilmCalibration>> CalibrateFromFilm(const ReplayOptions& options,
                                                         const OutputFolder& folder) {
  if (options.calibration || !IsFilm(options.recording)) return std::nullopt;
  PLEINAIR_ASSIGN_OR_RETURN(auto by_trajectory, CalibrateFromTrajectory(options, folder));
  if (by_trajectory) return by_trajectory;
  PLEINAIR_ASSIGN_OR_RETURN(const tracker::MarkerViewOptions views, ViewsOfScene(options));
  const std::string name = options.recording.string();
  PLEINAIR_ASSIGN_OR_RETURN(const auto pictures, OpenPictures({name}, {}));
  PLEINAIR_ASSIGN_OR_RETURN(const FilmLens film, EstimateFilmLens(*pictures, name, views));
  PLEINAIR_ASSIGN_OR_RETURN(
      const std::string text,
      devices::CalibrationText(film.lens.camera, devices::CalibrationForm::kOwn,
                               FilmLensNotes(film)));
  FilmCalibration calibration{
      folder.staging() / "camera_from_film.json",
      "No calibration was given. The film itself gives it (camera_from_film.json): " +
          FilmLensSentence(film) + "."};
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(calibration.file, text));
  return calibration;
}

}  // namespace pleinair::app
