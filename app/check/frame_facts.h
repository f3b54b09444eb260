#pragma once

#include <cstdint>
#include <optional>

#include "app/check/focal_from_marker.h"
#include "base/camera_model.h"
#include "base/camera_response.h"
#include "devices/frame.h"
#include "scene/marker_reflectance.h"
#include "tracker/observation.h"

namespace pleinair::app {

/// Measurements of the scene's marker in one frame.
struct FrameFacts {
  std::int64_t index = 0;
  double edge_px = 0.0;  ///< Mean edge in the image.
  double visible_fraction = 1.0;
  double ambiguity_ratio = 0.0;
  /// Standard deviation of the edges' blur, pixels; nothing: not measured.
  std::optional<double> blur_px;
  /// Median light of the white margin, linear, 1 = brightest pixel; nothing: not in view.
  std::optional<double> white;
  double clipped_share = 0.0;  ///< Share of the white-margin samples that are clipped.
  std::optional<FocalRatio> focal;
};

/// Measures a frame. `marker.size_m` of 0: a picture target, which has no white margin.
FrameFacts MeasureFrame(const devices::Frame& frame, const tracker::MarkerObservation& seen,
                        const CameraModel& camera, const scene::MarkerReflectance& marker,
                        const CameraResponse& response);

}  // namespace pleinair::app
