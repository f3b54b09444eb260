#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// The method by which a marker was found.
enum class DetectionPath { kFast, kSurfGolay, kTracked };

/// "fast", "surf-golay", "tracked": as in `detections.jsonl`.
const char* TrajectoryName(DetectionPath path);

/// A marker detected in an image, before its pose is estimated.
struct MarkerDetection {
  std::string family;  ///< "tag36h11", "sg", "picture", …
  /// Number of the marker. Unset for an S-G marker whose border is certain but whose number is not:
  /// too many of its cells are occluded.
  std::optional<int> id;
  std::string name;  ///< Name of an image target; empty for markers with an id.
  /// Corners of the outer black square, or of an image target, in pixels (integer = pixel centre):
  /// clockwise from top-left on the upright marker.
  std::array<Vec2, 4> corners_px;
  /// Visible share of the marker, 0…1; without an id, of its border.
  double visible_fraction = 1.0;
  DetectionPath path = DetectionPath::kFast;
  /// Visibility map: `visibility_side`² squares of the marker, quiet zone included, row by row from
  /// the top-left of the upright marker; 0 covered … 1 as predicted. Empty if unknown.
  int visibility_side = 0;
  std::vector<float> visibility;
};

/// A tracked marker that is not observed in the present frame.
struct LostMarker {
  std::string family;
  int id = 0;
  int frames = 0;      ///< Number of frames since it was lost.
  std::string name{};  ///< Name of an image target.
};

/// 6×6 covariance, row-major. Order: rotation vector (rad), then translation (m), both in the
/// camera frame: camera_from_marker' = (Exp(w) R, t + d).
using PoseCovariance = std::array<double, 36>;

/// One of the two solutions of the planar pose problem.
struct PoseSolution {
  Transform<Camera, Marker> camera_from_marker;
  double reprojection_rms_px = 0.0;
  double chi2 = 0.0;  ///< Squared reprojection error in units of the corners' standard deviations.
};

/// Ambiguity ratio below which a pose counts as certain: fewer than one in 1,000 such poses is the
/// wrong planar solution (docs/measurements/sg-marker.md).
inline constexpr double kCertainRatio = 1e-3;

struct PoseEstimate {
  PoseSolution best;
  std::optional<PoseSolution> alternative;  ///< The other planar solution, if there is one.
  /// Likelihood of the alternative relative to the best solution, from the corners and their
  /// covariance. Near 1: ambiguous; below kCertainRatio: decided by the image; 0 without an
  /// alternative.
  double ambiguity_ratio = 0.0;
  PoseCovariance covariance{};
};

struct MarkerObservation {
  MarkerDetection detection;
  PoseEstimate pose;
};

}  // namespace pleinair::tracker
