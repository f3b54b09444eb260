#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"
#include "tracker/observation.h"
#include "tracker/surf_golay/sg_options.h"
#include "tracker/unmeasured_markers.h"

namespace pleinair::tracker {

struct PictureTarget;

/// Range of marker edges, metres; outside it poses suffer from rounding.
inline constexpr double kMinMarker_m = 1e-4, kMaxMarker_m = 1e3;

struct TrackerOptions {
  std::vector<std::string> families{"tag36h11"};  ///< Marker families to detect.
  double marker_size_m = 0.0;  ///< Edge of the outer black square of all markers, metres.
  /// The images are consecutive frames of one camera. If one image alone does not decide between
  /// the two planar poses, the pose that continues the previous frame's is chosen.
  bool consecutive_frames = false;
  SgOptions sg{};  ///< For the family "sg".
  /// Image targets to detect (picture_target/picture_target.h), each of which exists once. They are
  /// reported as family "picture" with their index in this list as id.
  std::vector<std::shared_ptr<const PictureTarget>> targets{};
};

/// Detects markers and estimates their poses, frame after frame. One thread at a time, with the
/// exception of Find(), Align() and Conclude().
class Tracker {
 public:
  static Result<std::unique_ptr<Tracker>> Create(const CameraModel& camera,
                                                 const TrackerOptions& options);
  virtual ~Tracker() = default;

  /// Markers in one sRGB-encoded grey image of the camera's size; without markers, an empty list.
  /// Ordered by family, id (those without one first), then x of the first corner. Deterministic.
  Result<std::vector<MarkerObservation>> Track(ImageView<const std::uint8_t> grey);

  /// The three parts of Track(), for callers that process several images in parallel. Find()
  /// detects markers and depends on the previous images, so it must be called in the order of the
  /// frames. Align() refines corners and depends on nothing else; any number of threads may call
  /// it. Conclude() estimates poses, again in the order of the frames. The three may run
  /// concurrently.
  virtual Result<UnmeasuredMarkers> Find(ImageView<const std::uint8_t> grey) = 0;
  virtual void Align(ImageView<const std::uint8_t> grey, UnmeasuredMarkers* found) const = 0;
  virtual std::vector<MarkerObservation> Conclude(ImageView<const std::uint8_t> grey,
                                                  UnmeasuredMarkers found) = 0;

  /// Markers of previous frames that were not detected in the last one (only for consecutive
  /// frames, families "sg" and "picture").
  virtual std::vector<LostMarker> Lost() const = 0;
  /// Warnings for the user about the last image passed to Find(), for example about a mirrored
  /// marker.
  virtual std::vector<std::string> Warnings() const = 0;
};

}  // namespace pleinair::tracker
