#pragma once

#include <algorithm>
#include <cmath>

#include "sky/clouds/cloud_slab.h"

namespace pleinair::clouds {

/// Shares of what arrives at a layer, means over columns.
struct LayerShares {
  double reflected = 0.0, direct = 0.0, diffuse_reflected = 0.0;

  /// Light of the sun that arrives below, scattered and direct.
  double Transmitted() const { return 1.0 - reflected; }
};

/// Shares of a layer by columns that are tilted towards the sun (Várnai & Davies 1999, "tilted
/// independent columns"): R of the table at the optical depth of the ray times μ₀. The function
/// slant_depth(i) gives the depth of the i-th of `count` rays to the sun, column_depth(i) that of
/// the vertical column at its foot.
template <typename Slant, typename Column>
LayerShares SharesOfTiltedColumns(const SlabTable& table, double sun_cosine, int count,
                                  const Slant& slant_depth, const Column& column_depth) {
  const double cosine = std::max(sun_cosine, SlabTable::kMinCosine);
  LayerShares sum;
  for (int i = 0; i < count; ++i) {
    const double slant = slant_depth(i);
    sum.reflected += table.Reflected(slant * cosine, cosine) / count;
    sum.direct += std::exp(-slant) / count;
    sum.diffuse_reflected += table.DiffuseReflected(column_depth(i)) / count;
  }
  return sum;
}

}  // namespace pleinair::clouds
