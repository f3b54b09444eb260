#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "base/frames.h"

namespace pleinair::e2e {

/// One line of a TUM file: camera pose in the marker frame.
struct TumPose {
  double time_s = 0.0;
  Transform<Marker, Camera> marker_from_camera;
};

/// The poses of a TUM file, without comments.
std::vector<TumPose> ReadTum(const std::filesystem::path& file);

/// The pose at that time, to a microsecond; null if there is none.
const TumPose* PoseAt(const std::vector<TumPose>& poses, double time_s);

/// Error of a pose.
struct PoseError {
  double rotation_deg = 0.0;
  double position_share = 0.0;     ///< Camera in the marker frame, relative to the distance.
  double translation_share = 0.0;  ///< Marker in the camera frame, relative to the distance.
};

PoseError ErrorOf(const TumPose& found, const TumPose& truth);

/// Quantile of sorted values with linear interpolation; `share` 0…1.
double Percentile(std::vector<double> values, double share);

}  // namespace pleinair::e2e
