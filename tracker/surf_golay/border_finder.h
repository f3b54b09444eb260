#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/surf_golay/border_search.h"
#include "tracker/surf_golay/image_search.h"

namespace pleinair::tracker {

/// So many markers in view make it likely that there are more.
inline constexpr std::size_t kMinFoundToSearchOn = 3;

/// Finds markers by the keypoints of their borders (S-G): fits and reads the guesses of
/// BorderSearch. Keeps its buffers; one thread at a time.
class BorderFinder {
 public:
  /// Both are kept by reference.
  BorderFinder(const LensGrid& lens, ImageSearch& image) : lens_(lens), image_(image) {}

  /// Adds the markers of `grey`, the image of the search; whether there are any. Goes on as long as
  /// it finds more where it found several, or with `refill` from the first on, with keypoints in
  /// place of those on markers that are known.
  bool Find(ImageView<const std::uint8_t> grey, BorderSearch::Sizes sizes, bool refill = false);

 private:
  /// A guess after the first steps of its fit.
  struct RankedGuess {
    BlockFitState state, guess;  ///< Before the steps: guess.
    bool plain = false;          ///< The guess is plainly a border's, covers or not.
    double rank = 0.0;
  };

  /// Fits and reads guesses, the best first; whether any was a marker.
  bool TryGuesses(std::span<const BorderGuess> guesses);
  /// Fits a guess and reads it there, unless that was tried before or is not worth it.
  std::optional<SgReading> DecodeFitted(BlockFitState* state, bool* tried);

  const LensGrid& lens_;
  ImageSearch& image_;
  std::unique_ptr<BorderSearch> search_;  ///< Made when first needed.
  std::vector<std::array<Vec2, 4>> taken_;
  std::vector<BorderGuess> guesses_;
  std::vector<RankedGuess> ranked_guesses_;
  std::vector<Mat3> tried_;
};

}  // namespace pleinair::tracker
