#pragma once

#include "export/plots/vector_drawing.h"
#include "tracker/calibration/lens_calibration.h"

namespace pleinair::app {

/// Where in the picture the board was seen: each view's outline, each corner coloured by how far
/// off it is (blue none, red three times the RMS), and crosses where nothing was seen.
exports::VectorDrawing CoverageDrawing(const tracker::LensCalibration& calibration);

/// Residuals by regions of the picture: the mean as an arrow, drawn `kArrowScale` times as long,
/// and the RMS in px. Arrows that point the same way beside each other are what the lens model
/// misses.
exports::VectorDrawing ResidualDrawing(const tracker::LensCalibration& calibration);

/// What the lens does to a grid: without distortion (grey, dashed) and with it.
exports::VectorDrawing DistortionDrawing(const tracker::LensCalibration& calibration);

/// Where the board stood, from above and from the side, with the camera's field of view.
exports::VectorDrawing PlacesDrawing(const tracker::LensCalibration& calibration);

/// A part of the picture and its residuals.
struct ResidualRegion {
  int points = 0;
  Vec2 mean_px;
  double rms_px = 0.0;
};
constexpr int kRegionColumns = 6, kRegionRows = 4;
/// Row by row from the top-left.
std::vector<ResidualRegion> ResidualRegions(const tracker::LensCalibration& calibration);

}  // namespace pleinair::app
