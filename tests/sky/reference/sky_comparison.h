#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sky/color.h"
#include "tests/sky/reference/path_traced_sky.h"

namespace pleinair::sky::reference {

/// A direction of the dome (degrees, azimuth from the sun's) and the solid angle it stands for.
struct Sample {
  double elevation_deg, azimuth_deg, weight;
};

/// `rings` × `sectors` directions: elevations at the middles of even steps, azimuths over the half
/// circle, to which skies are symmetric.
std::vector<Sample> DomeSamples(int rings, int sectors);

/// How far a sky is from the reference.
struct Comparison {
  double rmse = 0.0;          ///< Root of the mean square of the difference over that of the truth.
  double shape_rmse = 0.0;    ///< The same after the best common factor.
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
