#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/marker_detector.h"
#include "tracker/quads/quad_detector.h"
#include "tracker/surf_golay/border_search.h"
#include "tracker/surf_golay/cell_lattice.h"
#include "tracker/surf_golay/orientation_test.h"
#include "tracker/surf_golay/sg_options.h"
#include "tracker/surf_golay/sg_reader.h"

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
  std::vector<LostMarker> Lost() const override;
  std::vector<std::string> Warnings() const override { return warnings_; }

 private:
  SgDetector(const CameraModel& camera, const SgOptions& options, bool consecutive_frames);

  struct Found {
    SgReading reading;
    DetectionPath path = DetectionPath::kFast;
    std::array<Vec2, 4> corners_undistorted;
  };
  /// A marker of the frames before.
  struct Known {
    int number = 0;
    std::array<Vec2, 4> corners_undistorted;  ///< In the last frame that saw it,
    std::array<Vec2, 4> velocity;             ///< … and their motion, per frame.
    bool has_velocity = false;
    double blur_px = 0.7;
    int frames_unseen = 0;
    double visible_fraction = 0.0;
  };

  /// A guess after the first steps of its fit.
  struct RankedGuess {
    BlockFitState state, guess;  ///< Before the steps: guess.
    bool plain = false;          ///< The guess is plainly a border's, covers or not.
    double rank = 0.0;
  };

  /// Where the cells of a marker may lie, and which way round.
  struct Placement {
    BlockFitState state;
    double correlation = 0.0;  ///< Of the border.
  };

  /// Of the side: two fits that ended so near to each other are one.
  static constexpr double kSamePlace = 0.04;
  /// … and two that are so far apart are surely not.
  static constexpr double kOtherPlace = 0.15;
  /// A marker of which less is observed may be a little beside: other guesses there are read as
  /// well.
  static constexpr double kSurelyVisible = 0.5;

  /// The best ways round for a marker whose square has these corners, clockwise; by pixels alone.
  std::array<BorderOrientation, 2> TestOrientation(std::array<Vec2, 4> corners_px);
  /// Follows the markers of the frames before. Returns those that may lie elsewhere: what is found
  /// anew counts as well.
  std::vector<SgReading> Track();
  void FindFast();
  /// By the border and the cells: all that is there beside what was found; where nothing was, the
  /// dearer ways only as long as the cheaper ones find nothing.
  void SearchImage();
  /// Whether it found any. Goes on as long as it finds more where it found several, or with
  /// `refill` from the first on, with keypoints in place of those on markers that are known.
  bool FindBySurf(BorderSearch::Sizes sizes, bool refill = false);
  void FindByCells();
  /// Fits and reads guesses, the best first; whether any was a marker.
  bool TryGuesses(std::span<const BorderGuess> guesses);
  /// Fits a guess and reads it there, unless that was tried before or is not worth it.
  std::optional<SgReading> DecodeFitted(BlockFitState* state, bool* tried);
  /// Correlation of the border's pixels this way round; 0 where another is better.
  double UprightCorrelation(const BlockFitState& state);
  bool Add(const SgReading& reading, DetectionPath path);
  /// Whether a reading of which little is observed lies, otherwise, where the border of a marker
  /// lies open: what covers its cells then passed for another's.
  bool ContradictsBorder(const SgReading& reading) const;
  /// Whether a marker was found there already, of which so much is observed or that lies just so.
  bool Taken(const Mat3& modules_from_undistorted, double visible = 0.0) const;
  std::array<Vec2, 4> CornersPx(const Mat3& modules_from_undistorted) const;
  bool RightWayRound(const SgReading& reading);
  /// A reading from a guess that is good already, proved by what is observed of the border at its
  /// place.
  std::optional<SgReading> DecodeAsGuessed(const BlockFitState& guess);
  void TryQuad(const Quad& quad);
  void Remember();

  const LensGrid lens_;
  const SgOptions options_;
  const bool consecutive_frames_;
  SgReader reader_;
  QuadDetector quads_;
  OrientationTest orientation_test_;
  std::unique_ptr<BorderSearch> search_;  ///< Made when first needed.
  ReducedImages reduced_;
  ImageView<const std::uint8_t> grey_;
  std::vector<Quad> observed_quads_;
  CellLattice lattice_;
  std::vector<LatticeGuess> lattices_;
  std::vector<Placement> placements_;
  std::vector<RankedGuess> ranked_guesses_;
  std::vector<BorderGuess> guesses_;
  std::vector<Mat3> tried_;
  std::vector<Found> found_;
  std::vector<Known> known_;
  std::vector<std::string> warnings_;
  std::vector<std::array<Vec2, 4>> taken_;
  int frame_ = 0;
};

}  // namespace pleinair::tracker
