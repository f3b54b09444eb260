#pragma once

#include <array>
#include <vector>

#include "compositor/picture/marker_in_image.h"

namespace pleinair::compositor {

/// What else blurs the marker's sides, pixels: top, left, bottom, right.
struct KnownSpread {
  std::array<double, 4> circles_px{};  ///< Diameters of their circles of confusion.
  std::array<double, 4> streaks_px{};  ///< How far they move across themselves while exposed.
};

/// Estimates the blur of each side of the outer black square: standard deviation in pixels. Returns
/// one value per side that is visible well enough, at most four. Omits places where the light
/// changes or an occluder lies. The estimates exclude what is `known`.
std::vector<double> EstimateEdgeBlur(const MarkerInImage& marker, const KnownSpread& known = {});

}  // namespace pleinair::compositor
