#pragma once

#include <nlohmann/json.hpp>

#include "app/calibrate/view_collection.h"
#include "tracker/calibration/board_finder.h"
#include "tracker/calibration/lens_calibration.h"

namespace pleinair::app {

/// The lens with its uncertainties, views, residuals by region and advice, as `calibrate --json`
/// prints it.
nlohmann::ordered_json CalibrationJson(const tracker::LensCalibration& calibration,
                                       const Collection& collection,
                                       const tracker::CalibrationBoard& board);

/// Prints the lens on standard output, and omitted views and advice on standard error.
void PrintCalibration(const tracker::LensCalibration& calibration, const Collection& collection,
                      const tracker::CalibrationBoard& board);

}  // namespace pleinair::app
