#pragma once

#include <map>
#include <string>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::devices {

/// The formats that ReadCalibration() (calibration.h) reads.
enum class CalibrationForm { kOwn, kOpenCvYaml, kOpenCvJson, kRos, kKalibr, kEuroc };

/// Writes a calibration in one of these formats. Reading it back gives the same numbers to the last
/// bit. `notes` are written as "quality", in pleinair's own format only. Errors (input): Kalibr and
/// EuRoC have four distortion coefficients, so a lens with more cannot be written.
Result<std::string> CalibrationText(const CameraModel& camera, CalibrationForm form,
                                    const std::map<std::string, double>& notes = {});

}  // namespace pleinair::devices
