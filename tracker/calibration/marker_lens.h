#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"
#include "tracker/pose/planar_pose.h"

namespace pleinair::tracker {

/// One marker in one frame of a film.
struct MarkerView {
  std::string name;                ///< Name of the frame, for messages.
  std::array<Vec2, 4> corners_px;  ///< Clockwise from top-left on the upright marker.
  CornerCovariance covariance_px2;
};

/// Standard deviations of the lens parameters.
struct MarkerLensDeviations {
  double focal_px = 0.0, cx_px = 0.0, cy_px = 0.0, k1 = 0.0, k2 = 0.0;
};

/// A lens estimated from the views of markers.
struct MarkerLens {
  CameraModel camera;  ///< fx = fy; distortion k1 and k2.
  MarkerLensDeviations deviations;
  double chi2 = 0.0;              ///< χ² of the corners per degree of freedom.
  double max_tilt_deg = 0.0;      ///< Between marker and image plane.
  double distance_ratio = 1.0;    ///< Largest distance of a marker over the smallest.
  std::vector<std::size_t> used;  ///< Indices of the views that were fitted.
};

/// Fewer views than this are rejected.
constexpr std::size_t kMinMarkerViews = 8;

/// Estimates the lens by bundle adjustment. The unknowns are the focal length f = fx = fy, the
/// principal point c, the distortion k1 and k2, and the pose of each view. They minimise
///
///   Σ_views r_vᵀ (C_v + σ₀² I)⁻¹ r_v + |c − c₀|² / σ_c² + k1² / σ_k² + k2² / σ_k².
///
/// r_v are the eight coordinates of a view's corners less their projections. C_v is their
/// covariance (Triggs et al. 2000, "Bundle adjustment", §3; priors as in §9.3). c₀ is the centre of
/// the image. σ_c is 1.5 % of its longer side, and σ_k is 0.3. σ₀ is 0.03 px: corners of printed
/// markers are not more accurate. The size of the markers does not matter.
///
/// The deviations come from the normal equations with the poses eliminated. They are multiplied by
/// the square root of χ² per degree of freedom where that exceeds 1. Views whose corners admit two
/// poses, and views that contradict the others, are not used.
///
/// The search starts from `start_focal_px`, if given, and from five others. Errors (input): fewer
/// than kMinMarkerViews usable views; no lens explains them.
Result<MarkerLens> EstimateMarkerLens(const std::vector<MarkerView>& views, int width, int height,
                                      std::optional<double> start_focal_px = {});

/// Errors (input): the views determine the focal length to worse than 1 % only, with what they
/// lack.
Result<void> CheckDetermined(const MarkerLens& lens);

}  // namespace pleinair::tracker
