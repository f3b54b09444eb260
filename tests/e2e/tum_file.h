#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "base/frames.h"

namespace pleinair::e2e {

/// One line of a TUM file: where the camera stood in the marker frame.
struct TumPose {
  double time_s = 0.0;
  Transform<Marker, Camera> marker_from_camera;
};

/// The poses of a TUM file, comments passed over.
std::vector<TumPose> ReadTum(const std::filesystem::path& file);

/// The pose of that moment, to a microsecond; null where there is none.
const TumPose* PoseAt(const std::vector<TumPose>& poses, double time_s);

/// How far a pose is from the truth.
struct PoseError {
  double rotation_deg = 0.0;
  double position_share = 0.0;     ///< Of the camera in the marker frame, over its true distance.
  double translation_share = 0.0;  ///< Of the marker in the camera frame, over its true distance.
};

PoseError ErrorOf(const TumPose& found, const TumPose& truth);

/// Between the two nearest of the sorted values, linearly; `share` 0…1.
double Percentile(std::vector<double> values, double share);

}  // namespace pleinair::e2e
