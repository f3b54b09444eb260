#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Which way a marker was found.
enum class DetectionPath { kFast, kSurfGolay, kTracked };

/// "fast", "surf-golay", "tracked": as `detections.jsonl` spells it.
const char* TrajectoryName(DetectionPath path);

/// A marker found in a picture, before its pose is known.
struct MarkerDetection {
  std::string family;  ///< "tag36h11", "sg", "picture", …
  int id = 0;
  std::string name;  ///< Of a target; empty where a number says it all.
  /// Corners of the outer black square, or of a target's picture, in pixels (integer = pixel
  /// centre), top-left, then clockwise, of the marker as its marker is read.
  std::array<Vec2, 4> corners_px;
  double visible_fraction = 1.0;  ///< Share of the marker that is observed, 0…1.
  DetectionPath path = DetectionPath::kFast;
  /// Which part of the marker is observed: `visibility_side`² squares of the marker, quiet zone
  /// included, row by row from the top-left as it is read, 0 covered … 1 as predicted. Empty where
  /// unknown.
  int visibility_side = 0;
  std::vector<float> visibility;
};

/// A marker that was followed and is not observed now.
struct LostMarker {
  std::string family;
  int id = 0;
  int frames = 0;      ///< Since how many frames.
  std::string name{};  ///< Of a target.
};

/// Order of the 6×6 covariance: rotation vector (rad), then translation (m), both in the camera
/// frame: camera_from_marker' = (Exp(w) R, t + d). Row-major.
using PoseCovariance = std::array<double, 36>;

/// One solution of the planar pose problem.
struct PoseSolution {
  Transform<Camera, Marker> camera_from_marker;
  double reprojection_rms_px = 0.0;
  double chi2 = 0.0;  ///< Squared length of that error in the corners' standard deviations.
};

/// Ambiguity ratio below which a pose is certain not to be the other planar solution: of such fewer
/// than one in 1,000 are (docs/measurements/sg-marker.md).
inline constexpr double kCertainRatio = 1e-3;

struct PoseEstimate {
  PoseSolution best;
  std::optional<PoseSolution> alternative;  ///< The other planar solution, where there is one.
  /// How likely the corners make the alternative, over the best one, with their covariance: near 1
  /// means that nobody can tell, below kCertainRatio that the picture has decided; 0 without one.
  double ambiguity_ratio = 0.0;
  PoseCovariance covariance{};
};

struct MarkerObservation {
  MarkerDetection detection;
  PoseEstimate pose;
};

}  // namespace pleinair::tracker
