#version 450 core
// What the virtual objects change of a real surface's light, see differential.glsl.

#include "compositor/shaders/differential.glsl"
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#include "shadows/shaders/shadow_visibility.glsl"

in vec3 v_position_m;
in vec3 v_normal;
centroid in vec3 v_ambient_with;
centroid in vec3 v_ambient_without;

uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.

layout(location = 0) out vec4 out_ratio;

// A change of light that no 8-bit picture shows.
const float kNoticeable = 0.002;

void main() {
  vec3 normal = normalize(v_normal);
  vec3 flat_normal = ShadowGeometricNormal(v_position_m, normal);
  vec3 step_x = dFdx(v_position_m);
  vec3 step_y = dFdy(v_position_m);
  vec3 sun = max(dot(normal, u_to_sun), 0.0) * u_sun_normal_lux;
  // Shadow maps are read only where the objects change the sun or the sky: elsewhere they cancel.
  // A loop that runs once or never: Mesa's software renderer runs an `if` whatever its condition.
#ifdef SHADOW_METHOD_SUN_DISC
  bool sun_may_change = ShadowInFinestPartition(1, v_position_m);
#else
  bool sun_may_change = true;
#endif
  vec3 change = abs(v_ambient_with - v_ambient_without) - kNoticeable * v_ambient_without;
  bool sky_changes = max(max(change.r, change.g), change.b) > 0.0;
  float visibility_phantoms = 1.0;
  float visibility_all = 1.0;
  int count = sun.g > 0.0 && (sun_may_change || sky_changes) ? 1 : 0;
  for (int i = 0; i < count; ++i) {
    visibility_phantoms = ShadowVisibility(0, v_position_m, flat_normal, step_x, step_y);
    visibility_all = ShadowVisibility(1, v_position_m, flat_normal, step_x, step_y);
  }
  out_ratio = vec4(DifferentialRatio(v_ambient_with, v_ambient_without, sun, visibility_all,
                                     visibility_phantoms),
                   1.0);
}
