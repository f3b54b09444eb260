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

/// Refines the poses of S-G markers by an alignment of all marker pixels
/// (tracker/refinement/marker_alignment.h). This takes some 20 ms per marker, which a recording
/// allows and a live camera does not. The error is a third of that of the tracker's block-wise fit.
/// AprilTags need no refinement, because the tracker already measures them this way.
class MarkerRefiner {
 public:
  MarkerRefiner(const CameraModel& camera, double marker_size_m)
      : camera_(camera), marker_size_m_(marker_size_m) {}

  /// Tracking result of a frame.
  struct Seen {
    ImageView<const std::uint8_t> grey;
    std::vector<tracker::MarkerObservation> observations;
  };

  /// Refines corners and poses of the observations; frames must come in order. Several frames are
  /// aligned in parallel, one thread per processor, with the same results. If too little of the
  /// marker is visible to confirm the alignment, its observation stays unchanged.
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
