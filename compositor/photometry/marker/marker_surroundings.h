#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/surface_samples.h"

namespace pleinair::compositor {

/// Brightness of the phantom surface around the marker's white margin. The surface and the marker
/// have the same light there, whatever casts a shadow on both.
struct MarkerSurroundings {
  SurfacePlane plane;
  double brightness =
      0.0;           ///< Median over surface samples of the mean logarithm of red, green and blue.
  LinearRgb albedo;  ///< As described for the surface.
};

/// Samples the surroundings where the model has them in the sun, up to half of `board_size_m`
/// beyond the white margin. Returns nothing where no phantom lies flush with the marker, or too
/// little of it shows. `sun_visible` has one flag per sample: the model has it in the sun.
std::optional<MarkerSurroundings> FindMarkerSurroundings(
    const SurfaceSamples& samples, const std::vector<std::uint8_t>& sun_visible);

}  // namespace pleinair::compositor
