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

/// Edges of markers that can be meant; beyond them poses are lost in rounding.
inline constexpr double kMinMarker_m = 1e-4, kMaxMarker_m = 1e3;

struct TrackerOptions {
  std::vector<std::string> families{"tag36h11"};  ///< Which markers to look for.
  double marker_size_m = 0.0;  ///< Edge of the outer black square of markers of these families.
  /// The pictures come one after another from one camera: where an image alone does not tell which
  /// of the two planar poses is right, the one that goes on from the image before is.
  bool consecutive_frames = false;
  SgOptions sg{};  ///< For the family "sg".
  /// Pictures to look for (picture_target/picture_target.h), each of which hangs in one place. They
  /// are sighted as family "image" with their place in this list as id.
  std::vector<std::shared_ptr<const PictureTarget>> targets{};
};

/// Finds markers and their poses, frame after frame. One thread at a time, but for what is said of
/// the parts of Track().
class Tracker {
 public:
  static Result<std::unique_ptr<Tracker>> Create(const CameraModel& camera,
                                                 const TrackerOptions& options);
  virtual ~Tracker() = default;

  /// Markers in one sRGB-encoded grey image of the camera's size; none is an empty list.
  /// Ordered by family, id, then the first corner's x: the same image gives the same list.
  Result<std::vector<MarkerObservation>> Track(ImageView<const std::uint8_t> grey);

  /// Track() in its parts, for who has several pictures at hand: to find markers, which leans on
  /// the pictures before; to align their prints, which leans on nothing, so that any number of
  /// threads may; and to conclude their poses, in the pictures' order again. Each part may run
  /// beside the others.
  virtual Result<UnmeasuredMarkers> Find(ImageView<const std::uint8_t> grey) = 0;
  virtual void Align(ImageView<const std::uint8_t> grey, UnmeasuredMarkers* found) const = 0;
  virtual std::vector<MarkerObservation> Conclude(ImageView<const std::uint8_t> grey,
                                                  UnmeasuredMarkers found) = 0;

  /// Markers of the frames before that the last one did not show (consecutive frames, families "sg"
  /// and "image").
  virtual std::vector<LostMarker> Lost() const = 0;
  /// What the user should know about the last image found in, such as prints that are mirrored.
  virtual std::vector<std::string> Warnings() const = 0;
};

}  // namespace pleinair::tracker
