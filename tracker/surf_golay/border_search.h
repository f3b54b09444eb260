#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf/described_keypoints.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/surf.h"
#include "tracker/surf_golay/border_templates.h"
#include "tracker/surf_golay/vote_bins.h"

namespace pleinair::tracker {

/// Hypothesis of a border's position, from its keypoints.
struct BorderGuess {
  Mat3 modules_from_undistorted;
  double votes = 0.0;  ///< Number of agreeing matches, weighted by similarity.
  int matches = 0;
};

struct BorderSearchOptions {
  /// The descriptor window is smaller than the paper's 20 scales: an occluder affects fewer
  /// descriptors of the border. The doubled first octave detects borders of less than 70 px: over
  /// mixtures of tilt, blur, noise and occlusion it raises the detection rate from .67 to .83.
  /// Every second pixel is sampled, as in the paper: sampling every pixel takes up to 1.75 times as
  /// long and detects no more.
  SurfOptions surf{.octaves = 3,
                   .threshold = 0.0002F,
                   .max_keypoints = 500,
                   .double_size = true,
                   .first_step = 2,
                   .descriptor_window_scales = 15};
  int neighbours = 4;             ///< Candidate matches of each keypoint of the frame.
  double rotation_bin_rad = 0.6;  ///< Width of the angle filter's bins, which overlap by half.
  double min_votes = 3.0;         ///< Minimum votes of a hypothesis that is fitted.
  int max_guesses = 40;
};

/// Finds borders in an image by SURF. Matches keypoints with the templates of all views, applies
/// the angle filter (Prochazka et al. 2012, §3.2), then groups matches that agree in the marker's
/// centre and size, then fits a homography to each group. The cost does not depend on how many
/// numbers are in use.
class BorderSearch {
 public:
  BorderSearch(const LensGrid& lens, BorderTemplates templates,
               const BorderSearchOptions& options = {});

  /// Borders of 70 px and more are detected in the image itself, at two thirds of the cost; smaller
  /// ones need the doubled image.
  enum class Sizes { kLarge, kAll };

  /// Excludes keypoints inside the `taken` quadrilaterals (known markers). With `refill`, weaker
  /// keypoints replace them: many markers have more keypoints than are described.
  void Find(ImageView<const std::uint8_t> grey, const std::vector<std::array<Vec2, 4>>& taken,
            Sizes sizes, bool refill, std::vector<BorderGuess>* guesses);

 private:
  /// A vote as the seed of a hypothesis: its bin and position in bins_, and its supporters.
  struct Ranked {
    int bin, place;
    double votes;
  };
  void CastVotes();
  void Gather(std::vector<BorderGuess>* guesses);
  bool FitGuess(const std::vector<int>& members, const BorderVote& seed, BorderGuess* guess);

  const LensGrid& lens_;
  const BorderTemplates templates_;
  const BorderSearchOptions options_;
  DescribedKeypoints frame_;
  DescriptorMatcher matcher_;
  std::vector<DescriptorMatch> templates_of_frame_;
  std::vector<BorderVote> votes_;
  VoteBins bins_;
  std::vector<Ranked> ranked_;
  std::vector<int> members_;
  std::vector<std::array<Vec2, 4>> guessed_corners_;
};

}  // namespace pleinair::tracker
