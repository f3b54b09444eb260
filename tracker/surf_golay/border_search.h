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

/// A place where a border may be, by its keypoints.
struct BorderGuess {
  Mat3 modules_from_undistorted;
  double votes = 0.0;  ///< How many matches agree, by their likeness.
  int matches = 0;
};

struct BorderSearchOptions {
  /// The window that is described is smaller than the paper's 20 scales: what covers a part of the
  /// border spoils fewer of its descriptors.
  /// The doubled first octave sees borders of less than 70 px: in mixtures of tilt, blur, noise and
  /// covers it takes the rate from .67 to .83. Every second pixel is sampled, as in the paper:
  /// every one costs up to three quarters more time and finds no more.
  SurfOptions surf{.octaves = 3,
                   .threshold = 0.0002F,
                   .max_keypoints = 500,
                   .double_size = true,
                   .first_step = 2,
                   .descriptor_window_scales = 15};
  int neighbours = 4;             ///< Candidates of each keypoint of the frame.
  double rotation_bin_rad = 0.6;  ///< Width of the angle filter's bins, which overlap by half.
  double min_votes = 3.0;         ///< Of a guess that is worth a look.
  int max_guesses = 40;
};

/// Finds borders in an image by SURF: matches of keypoints with templates observed from everywhere,
/// the angle filter (Prochazka et al. 2012, §3.2), then agreement of the matches in where the
/// marker's centre would be and how large it would be observed, then a homography of those that
/// agree. The cost does not depend on how many numbers are in use.
class BorderSearch {
 public:
  BorderSearch(const LensGrid& lens, BorderTemplates templates,
               const BorderSearchOptions& options = {});

  /// Borders of 70 px and more are observed in the image itself, at two thirds of the cost; smaller
  /// ones when it is doubled as well.
  enum class Sizes { kLarge, kAll };

  /// Keypoints inside `taken` quadrilaterals (markers that are known) are left out. With `refill`
  /// others, weaker ones, take their places: many markers have more keypoints than are described.
  void Find(ImageView<const std::uint8_t> grey, const std::vector<std::array<Vec2, 4>>& taken,
            Sizes sizes, bool refill, std::vector<BorderGuess>* guesses);

 private:
  /// A vote as the seed of a guess: its bin and place in bins_, and what agrees with it.
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
