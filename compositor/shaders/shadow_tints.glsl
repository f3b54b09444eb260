#ifndef COMPOSITOR_SHADOW_TINTS_GLSL
#define COMPOSITOR_SHADOW_TINTS_GLSL
// Tints of the shadow maps' partitions in the debug view, finest first.
const vec3 kPartitionTints[4] = vec3[4](vec3(1.0, 0.45, 0.4), vec3(0.5, 1.0, 0.45),
                                        vec3(0.45, 0.6, 1.0), vec3(1.0, 0.95, 0.4));
#endif
