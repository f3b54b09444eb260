#pragma once

// Lets a pure .glsl file (functions of numbers, no samplers, no uniforms) be compiled as C++ too,
// so that tests can compare it with a reference:
//
//     #include "gl/glsl_as_cpp.h"
//     namespace glsl {
//     using namespace glm;  // NOLINT: the point of the shim
//     #include "shadows/shaders/shadow_sun_disc.glsl"
//     }
//
// The .glsl guards itself with #ifndef, gives every function's parameters by value, and writes
// float literals as GLSL does ("0.5", which C++ reads as double and rounds on assignment): call
// glm's functions with float variables, not with bare literals.

#include <cmath>
#include <glm/glm.hpp>
