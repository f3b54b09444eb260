#ifndef COMPOSITOR_DIOPTRES_GLSL
#define COMPOSITOR_DIOPTRES_GLSL
// Distances along the optical axis from depth.

// Reciprocals of the view's near and far distances (shadows::View), 1/m.
uniform float u_near_dioptres;
uniform float u_far_dioptres;

// 1/z. Reciprocal distances are linear in the depth buffer.
float DioptresOf(float depth) { return mix(u_near_dioptres, u_far_dioptres, depth); }

#endif
