#pragma once

// sky/shaders/sky_perez.glsl compiled as C++: glm has GLSL's types and functions.
#include <glm/glm.hpp>

namespace pleinair::sky::glsl {

using namespace glm;  // NOLINT(google-build-using-namespace): GLSL has no namespaces.
#include "sky/shaders/sky_perez.glsl"

}  // namespace pleinair::sky::glsl
