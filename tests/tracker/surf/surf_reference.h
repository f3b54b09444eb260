#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/surf_descriptor.h"
#include "tracker/surf/surf_keypoint.h"

// SURF written down once more, plainly: sums over pixels, doubles, one sample after the other. What
// the vector code of tracker/surf/ is compared with.
namespace pleinair::tracker::reference {

/// Response (Bay et al. 2008, Eq. (3)) of the filters of `filter_size` px at (x, y); 0 where they
/// leave the image. `laplacian`, if given, gets D_xx + D_yy.
double Response(const GreyImage& grey, int filter_size, int x, int y, double* laplacian = nullptr);

/// The samples (not interpolated) at which a middle layer of an octave is the largest of its
/// 3 x 3 x 3 neighbours, which all fit into the image.
struct Sample {
  int filter_size, x, y;
  auto operator<=>(const Sample&) const = default;
};
std::vector<Sample> Maxima(const GreyImage& grey, int octave, int step, double threshold);

/// Mean (grey 0..255) of the box of `box` px around a point, sampled every `step` px and
/// interpolated, from the pixels inside the image nearest to it.
double BoxMean(const GreyImage& grey, int box, int step, double x, double y);

/// Section 4.1 (a window of a half-turn, a Gaussian of 2.5 s), without the histogram: the window
/// starts at each response in turn. `box` and `step`
/// of the box means are given.
double Direction(const GreyImage& grey, const SurfKeypoint& keypoint, int box, int step);

/// Section 4.2, with a window of 20 s.
SurfDescriptor Describe(const GreyImage& grey, const SurfKeypoint& keypoint, int box, int step);

/// The k nearest of `to` with the same sign, by sorting all.
std::vector<DescriptorMatch> Nearest(const QuantisedDescriptor& from,
                                     const std::vector<QuantisedDescriptor>& to, int k);

}  // namespace pleinair::tracker::reference
