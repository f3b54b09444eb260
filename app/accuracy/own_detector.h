#pragma once

#include <memory>

#include "accuracy/detector.h"
#include "base/camera_model.h"
#include "base/units.h"
#include "tracker/tracker.h"

namespace pleinair::app {

struct OwnDetectorOptions {
  tracker::TrackerOptions tracker{};  ///< One family and its size.
  /// Measure S-G prints once more from all their pixels, as `replay` does; else as `detect` does.
  bool measure_prints = false;
  /// Moves every corner by this much in a direction of its own, before the pose is estimated: a
  /// planted regression, to see that it is noticed.
  double spoil_corners_px = 0.0;
};

/// Our tracker as a detector that is measured; S-G prints.
std::unique_ptr<accuracy::Detector> MakeOwnDetector(const CameraModel& camera,
                                                    const OwnDetectorOptions& options);

}  // namespace pleinair::app
