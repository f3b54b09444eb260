#version 450 core
// Visibility at the points of a parallelogram: origin + column du + row dv.
#include "shadows/shaders/shadow_visibility.glsl"
uniform vec3 origin;
uniform vec3 du;
uniform vec3 dv;
uniform vec3 normal;
layout(location = 0) out float visibility;

void main() {
  vec3 position = origin + du * gl_FragCoord.x + dv * gl_FragCoord.y;
  visibility = ShadowVisibility(SHADOW_SETS - 1, position, normal);
}
