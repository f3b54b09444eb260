#version 450 core
// What the virtual objects change of a real surface's light, see differential.glsl. Drawn with
// SUN_MAY_CHANGE, SKY_CHANGES or NO_SUN: compositor/changing_triangles.h.

#include "compositor/shaders/differential.glsl"
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#endif
#include "shadows/shaders/shadow_visibility.glsl"

in vec3 v_position_m;
in vec3 v_normal;
centroid in vec3 v_ambient_with;
centroid in vec3 v_ambient_without;

uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.

layout(location = 0) out vec4 out_ratio;

void main() {
  // Permutations, not tests: Mesa's software renderer runs an `if` whatever its condition.
#ifdef NO_SUN
  vec3 sun = vec3(0.0);
  float visibility_phantoms = 0.0;
  float visibility_all = 0.0;
#else
  vec3 normal = normalize(v_normal);
  vec3 flat_normal = ShadowGeometricNormal(v_position_m, normal);
  vec3 step_x = dFdx(v_position_m);
  vec3 step_y = dFdy(v_position_m);
  vec3 sun = max(dot(normal, u_to_sun), 0.0) * u_sun_normal_lux;
  float visibility_phantoms = ShadowVisibility(0, v_position_m, flat_normal, step_x, step_y);
#ifdef SUN_MAY_CHANGE
  float visibility_all = ShadowVisibility(1, v_position_m, flat_normal, step_x, step_y);
#else
  float visibility_all = visibility_phantoms;
#endif
#endif
  out_ratio = vec4(DifferentialRatio(v_ambient_with, v_ambient_without, sun, visibility_all,
                                     visibility_phantoms),
                   1.0);
}
