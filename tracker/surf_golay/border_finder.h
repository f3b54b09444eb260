#pragma once

// Internal: shared by the .cc files of this module; not installed.

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

/// With this many markers in view, more are likely.
inline constexpr std::size_t kMinFoundToSearchOn = 3;

/// Detects markers by the keypoints of their borders (S-G): fits and decodes the hypotheses of
/// BorderSearch. Reuses its buffers; one thread at a time.
class BorderFinder {
 public:
  /// Both are kept by reference.
  BorderFinder(const LensGrid& lens, ImageSearch& image) : lens_(lens), image_(image) {}

  /// Adds the markers of `grey`, the search's image; returns whether it found any. Repeats while it
  /// finds several, or with `refill` from the first one on, with new keypoints in place of those on
  /// known markers.
  bool Find(ImageView<const std::uint8_t> grey, BorderSearch::Sizes sizes, bool refill = false);

 private:
  /// A hypothesis after the first steps of its fit.
  struct RankedGuess {
    BlockFitState state, guess;  ///< After the steps, and before.
    bool plain = false;          ///< The fit matches a border clearly, occluded or not.
    double rank = 0.0;
  };

  /// Fits and decodes hypotheses, the best first; returns whether any was a marker.
  bool TryGuesses(std::span<const BorderGuess> guesses);
  /// Fits and decodes a hypothesis, unless it was tried before or its fit is too poor.
  std::optional<SgReading> DecodeFitted(BlockFitState* state, bool* tried);

  const LensGrid& lens_;
  ImageSearch& image_;
  std::unique_ptr<BorderSearch> search_;  ///< Created on first use.
  std::vector<std::array<Vec2, 4>> taken_;
  std::vector<BorderGuess> guesses_;
  std::vector<RankedGuess> ranked_guesses_;
  std::vector<Mat3> tried_;
};

}  // namespace pleinair::tracker
