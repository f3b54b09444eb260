#ifndef COMPOSITOR_SHEEN_GLSL
#define COMPOSITOR_SHEEN_GLSL
// Light that the fibres of cloth scatter at grazing angles (Estevez & Kulla 2017, "Production
// Friendly Microfacet Sheen BRDF"; KHR_materials_sheen). Arithmetic only; also compiled as C++
// (gl/glsl_as_cpp.h, tests/compositor/shaders/ggx_test.cc).

const float kMinSheenRoughness = 0.2f;  // Minimum of the table below; smoother cloth is narrower.

// Estevez & Kulla 2017, Eq. (2), with alpha = roughness².
float DistributionCharlie(float n_dot_h, float alpha) {
  float inverse = 1.0f / alpha;
  float sine2 = max(1.0f - n_dot_h * n_dot_h, 0.0f);
  return (2.0f + inverse) * pow(sine2, 0.5f * inverse) / (2.0f * 3.14159265f);
}

// Ashikhmin & Premoze 2007, "Distribution-based BRDFs": shadowing without a parameter, as
// KHR_materials_sheen allows.
float VisibilityAshikhmin(float n_dot_v, float n_dot_l) {
  return 1.0f / max(4.0f * (n_dot_l + n_dot_v - n_dot_l * n_dot_v), 1e-4f);
}

// Reflectance under uniform light from all sides: integrals of the functions above, at most 1.
// Rows: roughness 0.2 to 1 in fifths. Columns: square root of n·v, 0 to 1 in eighths.
const int kSheenRoughnesses = 5, kSheenAngles = 9;
const float kSheenReflected[kSheenRoughnesses * kSheenAngles] = {
    1.0000, 1.0000, 1.0000, 0.6996, 0.3458, 0.1320, 0.0333, 0.0037, 0.0000,
    1.0000, 0.9979, 0.8103, 0.6153, 0.4346, 0.2791, 0.1550, 0.0656, 0.0112,
    0.8215, 0.7620, 0.6528, 0.5364, 0.4232, 0.3169, 0.2196, 0.1324, 0.0563,
    0.6978, 0.6541, 0.5744, 0.4896, 0.4064, 0.3265, 0.2500, 0.1764, 0.1046,
    0.6327, 0.5964, 0.5307, 0.4615, 0.3939, 0.3288, 0.2659, 0.2040, 0.1414};

float SheenReflectedAt(int roughness, float angle) {
  int below = min(int(angle), kSheenAngles - 2);
  int at = roughness * kSheenAngles + below;
  return mix(kSheenReflected[at], kSheenReflected[at + 1], angle - float(below));
}

float SheenReflectance(float roughness, float n_dot_v) {
  float row = (clamp(roughness, kMinSheenRoughness, 1.0f) - kMinSheenRoughness) * 5.0f;
  float angle = sqrt(clamp(n_dot_v, 0.0f, 1.0f)) * float(kSheenAngles - 1);
  int below = min(int(row), kSheenRoughnesses - 2);
  return mix(SheenReflectedAt(below, angle), SheenReflectedAt(below + 1, angle),
             row - float(below));
}

#endif
