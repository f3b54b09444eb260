#pragma once

#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "app/calibrate/picture_stream.h"
#include "base/error.h"
#include "base/image_size.h"
#include "tracker/calibration/marker_lens.h"
#include "tracker/calibration/marker_views.h"

namespace pleinair::app {

/// A lens estimated from the markers that a film shows.
struct FilmLens {
  tracker::MarkerLens lens;
  int looked_at = 0;    ///< Frames.
  int with_marker = 0;  ///< Frames with a marker.
  /// Focal length by the film's tags, pixels.
  std::optional<double> tag_focal_px;
};

/// Focal length in pixels from that of 35 mm film with the same diagonal angle of view (CIPA
/// DCG-001, 36 mm x 24 mm).
double FocalFrom35mm(double focal_length_35mm, ImageSize size);

/// Estimates the lens of a film from its markers (marker_views.h, marker_lens.h). The corners are
/// measured through the estimated lens and the lens is estimated again, until it stays. `source` is
/// for messages. Errors (input): unreadable images, images of different sizes, no marker, views
/// that do not determine the lens; (system): interrupted.
Result<FilmLens> EstimateFilmLens(PictureStream& pictures, const std::string& source,
                                  tracker::MarkerViewOptions options);

/// Two lines for a terminal.
std::string FilmLensText(const FilmLens& film);
/// One sentence: focal length and its standard deviation.
std::string FilmLensSentence(const FilmLens& film);
nlohmann::ordered_json FilmLensJson(const FilmLens& film);
/// Numbers on the quality of the calibration, for its file.
std::map<std::string, double> FilmLensNotes(const FilmLens& film);

}  // namespace pleinair::app
