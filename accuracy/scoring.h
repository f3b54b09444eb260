#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/frame_record.h"
#include "accuracy/frame_renderer.h"
#include "tracker/observation.h"

namespace pleinair::accuracy {

/// A reported detection.
struct Detected {
  int number = 0;
  std::array<Vec2, 4> corners_px{};
  std::optional<tracker::PoseEstimate> pose{};
  bool pose_has_covariance = false;
  double visible_fraction = 1.0;
  std::string path{};
  std::string family{};  ///< If the detector handles several families.
};

/// Matches detections to the ground truth. A detection hits a marker if its number is right and its
/// corners' RMS error is below the larger of 2 px and 3 % of the marker's mean edge; of several the
/// nearest counts. A detection that matches no marker, or one that is hit already, is a false
/// number.
void Score(const std::vector<MarkerTruth>& truth, const std::vector<Detected>& detected,
           FrameRecord* record);

/// Angle between two rotations, rad, 0…π; accurate near 0 too.
double AngleBetween(const Mat3& a, const Mat3& b);

/// NEES: eᵀ C⁻¹ e of an estimate against the ground truth, e = (w, d) with R_true = Exp(w)
/// R_estimate and t_true = t_estimate + d; nullopt if C is not positive definite. Bar-Shalom, Li &
/// Kirubarajan 2001, "Estimation with Applications to Tracking and Navigation", Eq. (5.4.2-6).
std::optional<double> Nees(const tracker::PoseEstimate& estimate,
                           const Transform<Camera, Marker>& truth);

}  // namespace pleinair::accuracy
