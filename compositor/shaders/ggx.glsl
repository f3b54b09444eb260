#ifndef COMPOSITOR_GGX_GLSL
#define COMPOSITOR_GGX_GLSL
// Microfacet reflection with the GGX distribution (Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces"); the whole after Cook & Torrance 1982.

const float kPi = 3.14159265358979;

// Walter et al. 2007, Eq. (33), with alpha = roughness².
float DistributionGgx(float n_dot_h, float alpha) {
  float a2 = alpha * alpha;
  float f = (n_dot_h * a2 - n_dot_h) * n_dot_h + 1.0;
  return a2 / (kPi * f * f);
}

// Height-correlated Smith visibility G / (4 n·l n·v) (Heitz 2014, "Understanding the
// Masking-Shadowing Function", Eq. (99)).
float VisibilitySmith(float n_dot_v, float n_dot_l, float alpha) {
  float a2 = alpha * alpha;
  float view = n_dot_l * sqrt((n_dot_v - a2 * n_dot_v) * n_dot_v + a2);
  float light = n_dot_v * sqrt((n_dot_l - a2 * n_dot_l) * n_dot_l + a2);
  return 0.5 / max(view + light, 1e-5);
}

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", Eq. (24).
vec3 FresnelSchlick(float cosine, vec3 f0) {
  return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0);
}

// Scale of the prefiltered environment: second sum of the split-sum approximation, fitted by
// Karis 2014, "Physically Based Shading on Mobile".
vec3 EnvironmentBrdf(vec3 f0, float roughness, float n_dot_v) {
  const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
  vec4 r = roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
  return f0 * ab.x + ab.y;
}

#endif
