#pragma once

#include <string>
#include <vector>

#include "base/camera_model.h"

namespace pleinair::app {

/// A result of `pleinair doctor`.
struct Finding {
  enum class Verdict { kGood, kDoubtful, kBad };
  Verdict verdict = Verdict::kGood;
  std::string subject;  ///< "OpenGL", "video encoder", "focal length", …
  std::string text;     ///< The result and, if it is not good, the remedy.
};

/// Checks whether edges of virtual objects get enough samples per pixel.
Finding ExamineSamples(int samples);

/// Checks the plausibility of a calibration:
/// - focal lengths relative to the image width and to each other;
/// - the principal point inside the image;
/// - a distortion that grows monotonically with the angle from the centre to beyond the image
/// corners. Otherwise two directions share one pixel.
std::vector<Finding> ExamineCalibration(const CameraModel& camera);

}  // namespace pleinair::app
