#ifndef COMPOSITOR_GGX_GLSL
#define COMPOSITOR_GGX_GLSL
// Microfacet reflection with the GGX distribution (Walter et al. 2007, "Microfacet Models for
// Refraction through Rough Surfaces"). The complete model follows Cook & Torrance 1982.

const float kPi = 3.14159265358979;

// Walter et al. 2007, Eq. (33), with alpha = roughness².
float DistributionGgx(float n_dot_h, float alpha) {
  float a2 = alpha * alpha;
  float f = (n_dot_h * a2 - n_dot_h) * n_dot_h + 1.0f;
  return a2 / (kPi * f * f);
}

// Height-correlated Smith visibility G / (4 n·l n·v) (Heitz 2014, "Understanding the
// Masking-Shadowing Function", Eq. (99)).
float VisibilitySmith(float n_dot_v, float n_dot_l, float alpha) {
  float a2 = alpha * alpha;
  float view = n_dot_l * sqrt((n_dot_v - a2 * n_dot_v) * n_dot_v + a2);
  float light = n_dot_v * sqrt((n_dot_l - a2 * n_dot_l) * n_dot_l + a2);
  return 0.5f / max(view + light, 1e-5f);
}

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", Eq. (24).
vec3 FresnelSchlick(float cosine, vec3 f0) {
  return f0 + (1.0f - f0) * pow(1.0f - cosine, 5.0f);
}

// Reflectance under uniform light from all sides is f0 · x + y (Karis 2013, "Real Shading in Unreal
// Engine 4", second sum). Rows: roughness 0 to 1 in fifths. Columns: square root of n·v, 0 to 1 in
// eighths. The values are integrals of the functions above.
const int kReflectedRoughnesses = 6, kReflectedAngles = 9;
const vec2 kReflected[kReflectedRoughnesses * kReflectedAngles] = {
    {0.0005, 0.9995}, {0.0757, 0.9243}, {0.2758, 0.7242}, {0.5313, 0.4687}, {0.7627, 0.2373},
    {0.9160, 0.0840}, {0.9840, 0.0160}, {0.9993, 0.0007}, {1.0000, 0.0000},
    {0.3901, 0.6113}, {0.3549, 0.5780}, {0.3791, 0.5201}, {0.5543, 0.4002}, {0.7617, 0.2219},
    {0.9096, 0.0832}, {0.9792, 0.0170}, {0.9967, 0.0009}, {0.9983, 0.0000},
    {0.7175, 0.2843}, {0.7023, 0.2724}, {0.6767, 0.2381}, {0.6866, 0.1868}, {0.7525, 0.1236},
    {0.8457, 0.0602}, {0.9181, 0.0176}, {0.9538, 0.0020}, {0.9677, 0.0000},
    {0.8682, 0.1335}, {0.8430, 0.1258}, {0.8084, 0.1061}, {0.7752, 0.0800}, {0.7560, 0.0524},
    {0.7565, 0.0280}, {0.7738, 0.0107}, {0.7989, 0.0021}, {0.8245, 0.0000},
    {0.9292, 0.0723}, {0.8891, 0.0659}, {0.8252, 0.0524}, {0.7573, 0.0370}, {0.6951, 0.0229},
    {0.6427, 0.0120}, {0.6016, 0.0049}, {0.5724, 0.0012}, {0.5551, 0.0000},
    {0.9540, 0.0473}, {0.8937, 0.0408}, {0.7932, 0.0297}, {0.6865, 0.0191}, {0.5868, 0.0109},
    {0.4987, 0.0053}, {0.4232, 0.0021}, {0.3597, 0.0006}, {0.3068, 0.0000}};

vec2 ReflectedAt(int roughness, float angle) {
  int below = min(int(angle), kReflectedAngles - 2);
  int at = roughness * kReflectedAngles + below;
  return mix(kReflected[at], kReflected[at + 1], angle - float(below));
}

// Scale of the prefiltered environment.
vec3 EnvironmentBrdf(vec3 f0, float roughness, float n_dot_v) {
  float row = clamp(roughness, 0.0f, 1.0f) * float(kReflectedRoughnesses - 1);
  float angle = sqrt(clamp(n_dot_v, 0.0f, 1.0f)) * float(kReflectedAngles - 1);
  int below = min(int(row), kReflectedRoughnesses - 2);
  vec2 reflected =
      mix(ReflectedAt(below, angle), ReflectedAt(below + 1, angle), row - float(below));
  return f0 * reflected.x + reflected.y;
}

#endif
