#pragma once

#include "export/plots/vector_drawing.h"
#include "tracker/calibration/lens_calibration.h"

namespace pleinair::app {

/// Image coverage by the board: each view's outline, each corner colored by its residual (blue
/// none, red three times the RMS). Crosses mark areas without observations.
exports::VectorDrawing CoverageDrawing(const tracker::LensCalibration& calibration);

/// Residuals by image region: the mean as an arrow, drawn `kArrowScale` times as long, and the RMS
/// in px. Neighbouring arrows in the same direction show an error of the lens model.
exports::VectorDrawing ResidualDrawing(const tracker::LensCalibration& calibration);

/// A grid without distortion (grey, dashed) and with the lens distortion.
exports::VectorDrawing DistortionDrawing(const tracker::LensCalibration& calibration);

/// Poses of the board from above and from the side, with the camera's field of view.
exports::VectorDrawing PlacesDrawing(const tracker::LensCalibration& calibration);

/// A region of the image and its residuals.
struct ResidualRegion {
  int points = 0;
  Vec2 mean_px;
  double rms_px = 0.0;
};
constexpr int kRegionColumns = 6, kRegionRows = 4;
/// Row by row from the top-left.
std::vector<ResidualRegion> ResidualRegions(const tracker::LensCalibration& calibration);

}  // namespace pleinair::app
