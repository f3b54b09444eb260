#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/output/output_folder.h"
#include "app/replay/replay_options.h"
#include "base/error.h"

namespace pleinair::app {

/// A calibration that was made for a replay.
struct FilmCalibration {
  std::filesystem::path file;
  std::string sentence;  ///< For the report.
};

/// The lens of a film that comes without a calibration. It is that of a given trajectory, written
/// to camera_from_trajectory.json in the output folder. A trajectory without a lens, or none: it is
/// estimated from the film's markers and written to camera_from_film.json. Nothing if a calibration
/// is given, or if the recording is not a film. Errors: those of EstimateFilmLens(); no scene, an
/// unreadable one.
Result<std::optional<FilmCalibration>> CalibrateFromFilm(const ReplayOptions& options,
                                                         const OutputFolder& folder);

}  // namespace pleinair::app
