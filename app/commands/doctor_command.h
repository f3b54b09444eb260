#pragma once

#include <string>
#include <vector>

#include "base/camera_model.h"

namespace pleinair::app {

/// What `pleinair doctor` found out about one thing.
struct Finding {
  enum class Verdict { kGood, kDoubtful, kBad };
  Verdict verdict = Verdict::kGood;
  std::string subject;  ///< "OpenGL", "video encoder", "focal length", …
  std::string text;     ///< What was found and, where it is not good, what to do.
};

/// Whether edges of virtual objects get as many samples a pixel as they should.
Finding ExamineSamples(int samples);

/// Whether a calibration is plausible: focal lengths against the picture's width and each other,
/// the principal point inside the picture, a distortion that keeps growing with the angle from the
/// centre to beyond the picture's corners (otherwise two directions share one pixel).
std::vector<Finding> ExamineCalibration(const CameraModel& camera);

}  // namespace pleinair::app
