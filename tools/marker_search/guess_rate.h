#pragma once

#include <array>
#include <vector>

#include "tools/marker_search/marker_views.h"
#include "tracker/surf_golay/border_search.h"

namespace pleinair::marker_search {

/// Success rate of BorderSearch on half-covered markers, end to end.
struct GuessRate {
  static constexpr int kSizes = 3, kTilts = 3;

  int scenes = 0;
  double rate = 0.0;  ///< Share of scenes in which one of the first ten guesses is right.
  std::array<double, kSizes> by_size{};  ///< Edges of 30…60, 60…100, 100…150 px.
  std::array<double, kTilts> by_tilt{};  ///< Tilts below 40°, 40…60°, 60…75°.
  double by_patches = 0.0;               ///< Scenes with patches in place of a half-plane.
};

/// Measures the rate on scenes of 320×320 px. Each shows a marker among textures: edge 30…150 px,
/// tilt up to 75°, half of the border covered. The same `seed` gives the same scenes for every
/// border.
GuessRate MeasureGuessRate(const tracker::sg::Border& border,
                           const std::vector<GreyImage>& textures, int scenes, std::uint64_t seed,
                           const tracker::BorderSearchOptions& options);

}  // namespace pleinair::marker_search
