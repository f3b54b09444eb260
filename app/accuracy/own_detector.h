#pragma once

#include <memory>

#include "accuracy/detector.h"
#include "base/camera_model.h"
#include "base/units.h"
#include "tracker/tracker.h"

namespace pleinair::app {

struct OwnDetectorOptions {
  tracker::TrackerOptions tracker{};  ///< One family and its size.
  /// Refine S-G markers with all their pixels, as `replay` does. Otherwise as `detect` does.
  bool measure_prints = false;
  /// Shifts every corner by this distance, each in its own direction, before pose estimation. An
  /// artificial regression, to test that it is detected.
  double spoil_corners_px = 0.0;
};

/// Wraps our tracker as a detector under test, for S-G markers.
std::unique_ptr<accuracy::Detector> MakeOwnDetector(const CameraModel& camera,
                                                    const OwnDetectorOptions& options);

}  // namespace pleinair::app
