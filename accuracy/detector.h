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

/// Interface of a detector under test. One thread at a time.
class Detector {
 public:
  virtual ~Detector() = default;

  /// Bit patterns of the markers that it detects; the scenes are rendered with them.
  virtual PatternByNumber Patterns() const = 0;

  /// Starts a single image or a video. Results must not depend on images before.
  virtual Result<void> Start(bool film) = 0;

  /// Detections of an image, with the time of each processing stage.
  struct Detections {
    std::vector<Detected> markers;
    int lost = 0;
    std::vector<std::pair<std::string, double>> stages_ms;
  };
  virtual Result<Detections> Detect(ImageView<const std::uint8_t> grey) = 0;
};

/// AprilTag 3 with its library's defaults (quad_decimate 2, one thread), for one of its families;
/// null for other markers. `edge`: side of the square whose corners it reports.
std::unique_ptr<Detector> MakeAprilTagPeer(const CameraModel& camera,
                                           std::string_view family = "tag36h11",
                                           Metres edge = kMarkerEdge);

/// OpenCV's ArUco module (corners refined by cornerSubPix, as its documentation recommends), for
/// its dictionary "4X4_50" and the AprilTag families that it supports; null for other markers.
std::unique_ptr<Detector> MakeArucoPeer(const CameraModel& camera,
                                        std::string_view family = "4X4_50",
                                        Metres edge = kMarkerEdge);

}  // namespace pleinair::accuracy
