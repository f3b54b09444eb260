#pragma once

// Internal: between the .cc files of this module; not installed.

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

/// Finds S-G markers, by the strategy of Prochazka et al. 2012, §5, with tracking between: in
/// consecutive frames a marker is looked for where it should be by now; what that does not find is
/// looked for as a quadrilateral (fast), and by the keypoints of its border (S-G) when a marker of
/// the frame before is missing, and every few frames for markers that are new and partly covered.
/// Where the border's keypoints find nothing the corners of the cells may. A single image is
/// searched in all ways.
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

  /// Follows the markers of the frames before. Returns those that may lie elsewhere: what is found
  /// anew counts as well.
  std::vector<SgReading> Track();
  void FindFast(ImageView<const std::uint8_t> grey);
  void TryQuad(const Quad& quad);
  /// By the border and the cells: all that is there beside what was found; where nothing was, the
  /// dearer ways only as long as the cheaper ones find nothing.
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
