#version 450 core
// Visibility of the sun and view depth at a surface. SHOW_PARTITIONS: the partition's index,
// fractional where two partitions blend.
#include "shadows/shaders/shadow_visibility.glsl"
in vec3 v_position;
uniform vec3 eye;
uniform vec4 depth_from_marker;
layout(location = 0) out vec2 visibility_and_depth;

void main() {
  vec3 normal = ShadowGeometricNormal(v_position, eye - v_position);
#ifdef SHOW_PARTITIONS
  float visible = ShadowPartition(SHADOW_SETS - 1, v_position);
#else
  float visible =
      ShadowVisibility(SHADOW_SETS - 1, v_position, normal, dFdx(v_position), dFdy(v_position));
#endif
  visibility_and_depth =
      vec2(visible, dot(depth_from_marker.xyz, v_position) + depth_from_marker.w);
}
