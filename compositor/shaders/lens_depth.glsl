#ifndef COMPOSITOR_LENS_DEPTH_GLSL
#define COMPOSITOR_LENS_DEPTH_GLSL
// Distances along the optical axis from the samples' depth.

layout(binding = 0) uniform sampler2DMS u_sample_depth;
uniform int u_samples;  // Per pixel.
// Reciprocals of the view's near and far distances (shadows::View), 1/m.
uniform float u_near_dioptres;
uniform float u_far_dioptres;

// 1/z. Reciprocal distances are linear in the depth buffer.
float DioptresOf(float depth) { return mix(u_near_dioptres, u_far_dioptres, depth); }

#endif
