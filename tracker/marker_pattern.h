#pragma once

#include <cstdint>
#include <vector>

namespace pleinair::tracker {

/// Marker bit pattern: a square of black and white modules, quiet zone included, upright.
struct MarkerPattern {
  int modules = 0;       ///< Modules along each side, quiet zone included.
  int edge_modules = 0;  ///< Modules along the side of the black square, whose corners are
                         ///< reported.
  std::vector<std::uint8_t> white;  ///< 1 white, 0 black; row-major from the top-left.
  /// Square of modules that differ from marker to marker: its first row and column, and its side.
  int unknown_first = 0, unknown_modules = 0;

  /// Half the printed side in half edges: the marker covers [-extent, extent] in both axes of the
  /// coordinates in which the reported corners are (±1, ±1).
  double Extent() const { return static_cast<double>(modules) / edge_modules; }
};

}  // namespace pleinair::tracker
