#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/marker_detector.h"
#include "tracker/quads/quad_detector.h"
#include "tracker/surf_golay/border_finder.h"
#include "tracker/surf_golay/cell_finder.h"
#include "tracker/surf_golay/image_search.h"
#include "tracker/surf_golay/known_markers.h"
#include "tracker/surf_golay/sg_options.h"

namespace pleinair::tracker {

/// Detects S-G markers by the strategy of Prochazka et al. 2012, §5, with tracking. In consecutive
/// frames a known marker is first searched at its predicted position. Then quadrilaterals are
/// decoded (fast path). When a marker of the previous frame is missing, and every few frames for
/// new, partly occluded markers, the keypoints of the border are searched (S-G). If these find
/// nothing, the corners of the cells are searched. A single image is searched by all methods.
class SgDetector final : public MarkerDetector {
 public:
  static Result<std::unique_ptr<SgDetector>> Create(const CameraModel& camera,
                                                    const SgOptions& options,
                                                    bool consecutive_frames);

  std::vector<Candidate> Detect(ImageView<const std::uint8_t> grey) override;
  std::vector<LostMarker> Lost() const override { return known_.Lost(); }
  std::vector<std::string> Warnings() const override { return warnings_; }

 private:
  SgDetector(const CameraModel& camera, const SgOptions& options, bool consecutive_frames);

  /// Tracks the markers of the previous frames. Returns those whose position is doubtful: a new
  /// detection elsewhere replaces them.
  std::vector<SgReading> Track();
  void FindFast(ImageView<const std::uint8_t> grey);
  void TryQuad(const Quad& quad);
  /// Searches by border and cells for markers that have not been found; if none was found, the more
  /// expensive methods run only as long as the cheaper ones find nothing.
  void SearchImage(ImageView<const std::uint8_t> grey);

  const LensGrid lens_;
  const SgOptions options_;
  const bool consecutive_frames_;
  ImageSearch image_;
  QuadDetector quads_;
  std::vector<Quad> observed_quads_;
  BorderFinder borders_;
  CellFinder cells_;
  KnownMarkers known_;
  std::vector<std::string> warnings_;
  int frame_ = 0;
};

}  // namespace pleinair::tracker
