#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/estimate/light_cell.h"

namespace pleinair::compositor {

/// Prior probabilities of the unmodelled shade at each place, from the shade of its neighbours
/// across the sun's rays (docs/method/light-fit.md, Eq. 1a).
///
/// What shades one place shades its neighbours as well, on whatever surface they lie. A place has
/// one of some mixes of shade. Its prior probabilities are a mean of the posterior ones of its
/// neighbours. These count by a normal distribution of their distance across the rays. One more
/// observation, to which all mixes are alike, counts with them.
class ShadeField {
 public:
  /// Only cells with a sunny part are neighbours. `to_sun`: unit, marker coordinates.
  ShadeField(const std::vector<LightCell>& cells, Vec3 to_sun);

  /// Prior probabilities, one row of `mixes` a cell and a last row of the marker's middle.
  /// `posterior` has one row a cell.
  std::vector<double> Prior(std::span<const double> posterior, std::size_t mixes) const;

 private:
  std::vector<std::vector<std::pair<std::uint32_t, double>>> neighbours_;  // With their weights.
};

}  // namespace pleinair::compositor
