#pragma once

#include <string>
#include <vector>

#include "tracker/observation.h"

namespace pleinair::app {

/// Sightings as a JSON array on one line, as `detect` and `detections.jsonl` have them: `family`,
/// `id`, `corners` (pixels, integer = centre, top-left then clockwise), `camera_from_marker` with
/// `rotation` (row-major) and `translation_m`, `covariance` (6×6 row-major, tracker/observation.h),
/// `reprojection_rms_px`, `ambiguity_ratio`, `visible_fraction`, `alternative` (null or a pose with
/// its `reprojection_rms_px`) and `path`. Numbers are the shortest that read back the same.
std::string MarkersJson(const std::vector<tracker::MarkerObservation>& observations);

/// Markers that are no longer seen as a JSON array: family, id and since how many frames.
std::string LostJson(const std::vector<tracker::LostMarker>& lost);

}  // namespace pleinair::app
