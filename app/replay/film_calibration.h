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

/// Estimates the lens of a film that comes without a calibration from its markers, and writes
/// camera_from_film.json to the output folder. Nothing if a calibration is given, or if the
/// recording is not a film. Errors: those of EstimateFilmLens(); no scene, an unreadable one.
Result<std::optional<FilmCalibration>> CalibrateFromFilm(const ReplayOptions& options,
                                                         const OutputFolder& folder);

}  // namespace pleinair::app
