#pragma once

#include <glm/glm.hpp>

#include "base/vector.h"

namespace pleinair::compositor {

/// Vectors and colors as uniforms take them, in single precision; the unit stays.
inline glm::vec3 ToGlm(Vec3 v) { return {v.x, v.y, v.z}; }
inline glm::vec3 ToGlm(LinearRgb c) { return {c.r, c.g, c.b}; }

}  // namespace pleinair::compositor
