#pragma once

#include <string>
#include <vector>

#include "app/calibrate/view_collection.h"
#include "tracker/calibration/lens_calibration.h"

namespace pleinair::app {

/// Facts on the page in addition to the calibration.
struct CalibrationFacts {
  std::string command;
  std::string board;
  std::string title;
  int looked_at = 0;  ///< Images.
  int with_board = 0;
};

/// One page without external resources. It shows the lens with its uncertainties, coverage,
/// residuals by region, distortion, board poses, and the views with their corners. It follows the
/// reader's light or dark mode.
std::string CalibrationPage(const CalibrationFacts& facts,
                            const tracker::LensCalibration& calibration,
                            const std::vector<CollectedView>& views);

/// Names of the distortion coefficients, in the order of CameraModel::distortion.
std::vector<const char*> CoefficientNames(const CameraModel& camera);

}  // namespace pleinair::app
