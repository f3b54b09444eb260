#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>
#include <vector>

#include "tracker/surf/integral_image.h"

namespace pleinair::tracker {

/// Weight of D_xy against D_xx and D_yy in the determinant (Bay et al. 2008, section 3.2, Eq. (3)).
inline constexpr float kMixedDerivativeWeight = 0.9f;

/// Row differences of the integral image that the filters of one row share; memory is reused.
struct HessianScratch {
  std::array<std::vector<std::int32_t>, 3> differences;
  std::array<std::vector<std::int32_t>, 3> phases;
};

/// Samples [first, last) of a row.
struct SampleRange {
  int first, last;
};

/// One row of the blob response (Bay et al. 2008, Eq. (3)),
///   det(H) = D_xx D_yy - (0.9 D_xy)^2,
/// each D the sum of box filters of L = `filter_size` px (section 3.2, Fig. 2; L = 9, 15, 21, ...)
/// divided by its area L^2, grey in 0..1. Samples i = 0, 1, ... are at x = i * `step` (1, 2 or 4),
/// for x < width. Where the filter would extend beyond the image the response is 0. Sample i is
/// stored in responses[i], which must have room for IntegralImage::kPadding more than `samples`;
/// the padding may be overwritten.
void ComputeHessianRow(const IntegralImage& integral, int filter_size, int step, int y,
                       SampleRange samples, HessianScratch* scratch, float* responses);

/// D_xx + D_yy at one point, by the same filters, which must fit into the image.
float LaplacianAt(const IntegralImage& integral, int filter_size, int x, int y);

}  // namespace pleinair::tracker
