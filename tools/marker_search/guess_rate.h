#pragma once

#include <array>
#include <vector>

#include "tools/marker_search/marker_views.h"
#include "tracker/surf_golay/border_search.h"

namespace pleinair::marker_search {

/// How often BorderSearch guesses where half covered markers are, end to end.
struct GuessRate {
  static constexpr int kSizes = 3, kTilts = 3;

  int scenes = 0;
  double rate = 0.0;  ///< Of scenes in which a guess is right among the first ten.
  std::array<double, kSizes> by_size{};  ///< Of edges of 30…60, 60…100, 100…150 px.
  std::array<double, kTilts> by_tilt{};  ///< Of tilts below 40°, 40…60°, 60…75°.
  double by_patches = 0.0;  ///< Where patches cover half of the border, not one side of a line.
};

/// Scenes of 320×320 px: a marker of an edge of 30…150 px, tilted up to 75°, half of its border
/// covered, among textures. The same `seed` makes the same scenes of all borders.
GuessRate MeasureGuessRate(const tracker::sg::Border& border,
                           const std::vector<GreyImage>& textures, int scenes, std::uint64_t seed,
                           const tracker::BorderSearchOptions& options);

}  // namespace pleinair::marker_search
