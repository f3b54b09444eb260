#pragma once

#include <string>
#include <vector>

#include "app/calibrate/view_collection.h"
#include "tracker/calibration/lens_calibration.h"

namespace pleinair::app {

/// What the page says beside the calibration itself.
struct CalibrationFacts {
  std::string command;
  std::string board;
  std::string title;
  int looked_at = 0;  ///< Pictures.
  int with_board = 0;
};

/// One page without any external resource: the lens with its uncertainties, coverage, residuals by
/// region, distortion, where the board stood, and the views with their corners. Follows the
/// reader's light or dark mode.
std::string CalibrationPage(const CalibrationFacts& facts,
                            const tracker::LensCalibration& calibration,
                            const std::vector<CollectedView>& views);

/// Names of the lens's numbers, in the order of CameraModel::distortion.
std::vector<const char*> CoefficientNames(const CameraModel& camera);

}  // namespace pleinair::app
