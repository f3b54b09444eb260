#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sky/color.h"
#include "tests/sky/reference/path_traced_sky.h"

namespace pleinair::sky::reference {

/// A direction of the dome (degrees, azimuth relative to the sun's) and its solid angle.
struct Sample {
  double elevation_deg, azimuth_deg, weight;
};

/// `rings` × `sectors` directions: elevations at the centres of equal steps, azimuths over the half
/// circle. Skies are symmetric about the sun's azimuth.
std::vector<Sample> DomeSamples(int rings, int sectors);

/// Errors of a sky relative to the reference.
struct Comparison {
  double rmse = 0.0;          ///< RMS difference relative to the RMS of the truth.
  double shape_rmse = 0.0;    ///< The same after the best common scale factor.
  double illuminance = 0.0;   ///< Ratio of the horizontal illuminances.
  double chromaticity = 0.0;  ///< Mean distance in x, y.
};

using SkyFunction = std::function<XyY(const Sample&)>;

std::vector<XyY> Evaluate(const std::vector<Sample>& samples, const SkyFunction& sky);
/// The path-traced sky in the same directions.
std::vector<XyY> PathTrace(const std::vector<Sample>& samples, const Scene& scene, int paths,
                           std::uint64_t seed);
Comparison Compare(const std::vector<Sample>& samples, const std::vector<XyY>& truth,
                   const std::vector<XyY>& sky);

}  // namespace pleinair::sky::reference
