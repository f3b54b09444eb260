#pragma once

#include <string>
#include <vector>

#include "base/vector.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// A model of convex plane polygons, metres, in one diffuse linear color: surfaces that a scene
/// describes without a file. `name` serves messages.
Model PolygonModel(const std::string& name, const std::vector<std::vector<Vec3>>& polygons,
                   LinearRgb reflectance);

}  // namespace pleinair::compositor
