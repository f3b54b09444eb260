#pragma once

#include <memory>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "sky/clouds/cloud_field.h"

namespace pleinair::clouds {

using CloudFields = std::vector<std::shared_ptr<const CloudField>>;

/// The fields of layers. Takes about 0.1 s a layer, unless equal ones are in use.
CloudFields MakeFields(const std::vector<CloudLayer>& layers);

/// Share of direct sunlight that the layers let through to a point: the mean of e^(−τ) over the
/// sun's disc (0.533°). `to_sun`: unit vector, east, north, up; `point_m`: the same axes, from the
/// place. 0 for a sun below the horizon.
///
/// The disc is sampled by 64 parallel rays, spread over the part of a layer that it covers as seen
/// from the point. That is exact for layers that are thin against their distance. A homogeneous
/// layer gives e^(−τ/μ₀) exactly.
double SunTransmittance(const CloudFields& fields, Vec3 point_m, Direction<World> to_sun,
                        double seconds);

/// As that, for a sun without extent.
double PointSunTransmittance(const CloudFields& fields, Vec3 point_m, Direction<World> to_sun,
                             double seconds);

}  // namespace pleinair::clouds
