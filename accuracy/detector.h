#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "accuracy/frame_renderer.h"
#include "accuracy/scoring.h"
#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"

namespace pleinair::accuracy {

/// A detector that is measured. One thread at a time.
class Detector {
 public:
  virtual ~Detector() = default;

  /// The print that it reads; the scenes are rendered with it.
  virtual PatternByNumber Patterns() const = 0;

  /// A single picture comes next, or the first frame of a film. What was seen before must not
  /// matter.
  virtual Result<void> Start(bool film) = 0;

  /// What it sees, with the time of each of its stages.
  struct Detections {
    std::vector<Detected> markers;
    int lost = 0;
    std::vector<std::pair<std::string, double>> stages_ms;
  };
  virtual Result<Detections> Detect(ImageView<const std::uint8_t> grey) = 0;
};

/// AprilTag 3 as its library comes (quad_decimate 2, one thread), for one of its families; null for
/// prints of other kinds. `edge`: of the square whose corners it reports.
std::unique_ptr<Detector> MakeAprilTagPeer(const CameraModel& camera,
                                           std::string_view family = "tag36h11",
                                           Metres edge = kMarkerEdge);

/// OpenCV's ArUco module (corners refined by cornerSubPix, as its users are told to), for its
/// dictionary "4X4_50", or for the AprilTag families that it has dictionaries of; null for prints
/// of other kinds.
std::unique_ptr<Detector> MakeArucoPeer(const CameraModel& camera,
                                        std::string_view family = "4X4_50",
                                        Metres edge = kMarkerEdge);

}  // namespace pleinair::accuracy
