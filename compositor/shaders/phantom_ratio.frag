#version 450 core
// What the virtual objects change of a real surface's light, see differential.glsl.

#include "compositor/shaders/differential.glsl"
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#include "shadows/shaders/shadow_visibility.glsl"

in vec3 v_position_m;
in vec3 v_normal;
in vec3 v_ambient_with;
in vec3 v_ambient_without;

uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.

layout(location = 0) out vec4 out_ratio;

void main() {
  vec3 normal = normalize(v_normal);
  float cosine = max(dot(normal, u_to_sun), 0.0);
  float visibility_phantoms = 1.0;
  float visibility_all = 1.0;
  vec3 flat_normal = ShadowGeometricNormal(v_position_m, normal);
  if (cosine > 0.0) {
    visibility_phantoms = ShadowVisibility(0, v_position_m, flat_normal);
    visibility_all = ShadowVisibility(1, v_position_m, flat_normal);
  }
  out_ratio = vec4(DifferentialRatio(v_ambient_with, v_ambient_without, cosine * u_sun_normal_lux,
                                     visibility_all, visibility_phantoms),
                   1.0);
}
