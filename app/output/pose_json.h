#pragma once

#include <string>
#include <vector>

#include "tracker/observation.h"

namespace pleinair::app {

/// Observations as a JSON array on one line, as in `detect` and `detections.jsonl`. The members
/// are:
/// - `family`, `id`, `corners` (pixels, integer = centre, top-left then clockwise);
/// - `camera_from_marker` with `rotation` (row-major) and `translation_m`;
/// - `covariance` (6×6 row-major, tracker/observation.h), `reprojection_rms_px`, `ambiguity_ratio`,
/// `visible_fraction`;
/// - `alternative` (null or a pose with its `reprojection_rms_px`) and `path`.
/// Numbers have the fewest digits that parse back to the same value.
std::string MarkersJson(const std::vector<tracker::MarkerObservation>& observations);

/// Lost markers as a JSON array: family, id and number of frames since the last observation.
std::string LostJson(const std::vector<tracker::LostMarker>& lost);

}  // namespace pleinair::app
