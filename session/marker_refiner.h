#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/camera_model.h"
#include "base/image.h"
#include "session/marker_tracks.h"
#include "tracker/marker_pattern.h"
#include "tracker/observation.h"
#include "tracker/refinement/marker_alignment.h"

namespace pleinair::session {

/// Measures S-G markers once more, from every pixel of their prints at once (tracker/
/// print_alignment.h). That takes some 20 ms a marker, which a recording has and a camera has not,
/// and leaves a third of the error that the tracker's own fit by blocks has. AprilTags have been
/// measured so already.
class MarkerRefiner {
 public:
  MarkerRefiner(const CameraModel& camera, double marker_size_m)
      : camera_(camera), marker_size_m_(marker_size_m) {}

  /// What the tracker saw in a frame.
  struct Seen {
    ImageView<const std::uint8_t> grey;
    std::vector<tracker::MarkerObservation> observations;
  };

  /// Gives what the tracker saw better corners and poses; frames come in order, and several at once
  /// are aligned on as many threads as there are processors, with the same results. Where a print
  /// does not bear out the alignment, since too little of it is seen, its observation stays as it
  /// is.
  void Measure(std::span<Seen> frames);
  std::vector<tracker::MarkerObservation> Measure(
      ImageView<const std::uint8_t> grey, std::vector<tracker::MarkerObservation> observations);

 private:
  using Alignments = std::vector<std::optional<tracker::MarkerAlignment>>;

  Alignments Align(const Seen& seen) const;
  void TakeOver(const std::optional<tracker::MarkerAlignment>& alignment,
                tracker::MarkerObservation* observation);

  struct Marker {
    std::shared_ptr<const tracker::MarkerPattern> pattern;
    Mat3 last_rotation;
    bool seen = false;
  };

  const CameraModel camera_;
  const double marker_size_m_;
  std::map<MarkerName, Marker> markers_;
};

}  // namespace pleinair::session
