#pragma once

#include <cstdint>
#include <memory>
#include <string>
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
  virtual PrintsByNumber Prints() const = 0;

  /// A single picture comes next, or the first frame of a film. What was seen before must not
  /// matter.
  virtual Result<void> Start(bool film) = 0;

  /// What it sees, with the time of each of its stages.
  struct Seen {
    std::vector<Detected> markers;
    int lost = 0;
    std::vector<std::pair<std::string, double>> stages_ms;
  };
  virtual Result<Seen> Detect(ImageView<const std::uint8_t> grey) = 0;
};

/// AprilTag 3 as its library comes (tag36h11, quad_decimate 2, one thread).
std::unique_ptr<Detector> MakeAprilTagPeer(const CameraModel& camera);

/// OpenCV's ArUco module (dictionary 4X4_50, corners refined by cornerSubPix, as its users are told
/// to).
std::unique_ptr<Detector> MakeArucoPeer(const CameraModel& camera);

}  // namespace pleinair::accuracy
