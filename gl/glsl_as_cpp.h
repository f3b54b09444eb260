#pragma once

// Compiles a pure .glsl file (numeric functions, no samplers, no uniforms) as C++, so that tests
// can compare it with a reference implementation:
//
//     #include "gl/glsl_as_cpp.h"
//     namespace glsl {
//     using namespace glm;  // NOLINT: the point of the shim
//     #include "shadows/shaders/shadow_sun_disc.glsl"
//     }
//
// Requirements on the .glsl: its own #ifndef guard; all parameters by value; float literals as in
// GLSL ("0.5", which C++ reads as double and rounds on assignment), so glm's functions must be
// called with float variables, not with bare literals.

#include <cmath>
#include <glm/glm.hpp>
