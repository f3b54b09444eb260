#version 450 core
// Tint of the shadow map partition of a surface; white outside all partitions.
#include "compositor/shaders/shadow_tints.glsl"
#include "shadows/shaders/shadow_visibility.glsl"

in vec3 v_position_m;
layout(location = 0) out vec4 out_tint;

void main() {
  float partition_number = ShadowPartition(0, v_position_m);
  int low = clamp(int(partition_number), 0, 3);
  vec3 tint = mix(kPartitionTints[low], kPartitionTints[min(low + 1, 3)],
                  fract(max(partition_number, 0.0)));
  out_tint = vec4(partition_number < 0.0 ? vec3(1.0) : tint, 1.0);
}
