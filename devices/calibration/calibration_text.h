#pragma once

#include <map>
#include <string>

#include "base/camera_model.h"
#include "base/error.h"

namespace pleinair::devices {

/// The forms that ReadCalibration (calibration.h) reads.
enum class CalibrationForm { kOwn, kOpenCvYaml, kOpenCvJson, kRos, kKalibr, kEuroc };

/// A lens in one of these forms, read back as the same numbers to the last bit. `notes` go into our
/// own form, as "quality". Errors (input): Kalibr and EuRoC have four coefficients, so that a lens
/// with more cannot be written for them.
Result<std::string> CalibrationText(const CameraModel& camera, CalibrationForm form,
                                    const std::map<std::string, double>& notes = {});

}  // namespace pleinair::devices
