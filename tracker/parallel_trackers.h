#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/image.h"
#include "tracker/observation.h"
#include "tracker/tracker.h"
#include "tracker/unmeasured_markers.h"

namespace pleinair::tracker {

/// Detects markers in images that do not follow each other, several at a time. The results are
/// those of one Tracker, image by image, on any number of processors.
class ParallelTrackers {
 public:
  /// `images`: at most so many are given at a time. Consecutive frames are not for it:
  /// options.consecutive_frames must be false. Errors: those of Tracker::Create().
  static Result<ParallelTrackers> Create(const CameraModel& camera, const TrackerOptions& options,
                                         std::size_t images);

  /// Tracker::Find() of each image. Errors: those of the first image that has one.
  Result<std::vector<UnmeasuredMarkers>> Find(std::span<const ImageView<const std::uint8_t>> greys);
  /// Tracker::Track() of each image. Errors: those of the first image that has one.
  Result<std::vector<std::vector<MarkerObservation>>> Track(
      std::span<const ImageView<const std::uint8_t>> greys);

 private:
  std::vector<std::unique_ptr<Tracker>> trackers_;  // One for each thread.
};

}  // namespace pleinair::tracker
