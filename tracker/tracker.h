#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"
#include "tracker/sighting.h"

namespace pleinair::tracker {

struct TrackerOptions {
  std::vector<std::string> families{"tag36h11"};  ///< Which markers to look for.
  double marker_size_m = 0.0;                     ///< Edge of the outer black square.
  /// The pictures come one after another from one camera: where a picture alone does not tell which
  /// of the two planar poses is right, the one that goes on from the picture before is.
  bool consecutive_frames = false;
};

/// Finds markers and their poses, frame after frame. One thread at a time.
class Tracker {
 public:
  static Result<std::unique_ptr<Tracker>> Create(const CameraModel& camera,
                                                 const TrackerOptions& options);
  virtual ~Tracker() = default;

  /// Markers in one sRGB-encoded grey picture of the camera's size; none is an empty list.
  /// Ordered by family, id, then the first corner's x: the same picture gives the same list.
  virtual Result<std::vector<Sighting>> Track(ImageView<const std::uint8_t> grey) = 0;
};

}  // namespace pleinair::tracker
