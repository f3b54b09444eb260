#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// What the phantom that the marker lies on shows around its board: the surface and the marker have
/// the same light there, whatever casts a shadow on both.
struct MarkerSurroundings {
  SurfacePlane plane;
  double brightness =
      0.0;           ///< Median over surface samples of the mean logarithm of red, green and blue.
  LinearRgb albedo;  ///< Stated for the surface.
};

/// Nothing where no phantom lies flush with the marker, or too little of it shows within half a
/// board's width of the board that the model has in the sun. `reached`, of each sample: whether it
/// does.
std::optional<MarkerSurroundings> FindMarkerSurroundings(
    const SurfaceSamples& samples, const std::vector<std::uint8_t>& sun_visible);

}  // namespace pleinair::compositor
