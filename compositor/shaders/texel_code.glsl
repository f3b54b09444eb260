#ifndef COMPOSITOR_TEXEL_CODE_GLSL
#define COMPOSITOR_TEXEL_CODE_GLSL
// Roughness, metallic and alpha in one 16-bit floating-point number, whose integers are exact to 2048.
// Arithmetic only; also compiled as C++ (gl/glsl_as_cpp.h,
// tests/compositor/shaders/shader_twins_test.cc).

const float kRoughnessSteps = 127.0f, kMetallicSteps = 15.0f;

float CodeOfCoat(float roughness, float metallic) {
  return floor(roughness * kRoughnessSteps + 0.5f) * (kMetallicSteps + 1.0f) +
         floor(metallic * kMetallicSteps + 0.5f);
}

// The same for blended surfaces, coarser: the textures of few vary roughness and metallic.
const float kAlphaSteps = 127.0f, kBlendedRoughnessSteps = 7.0f;

float CodeOfBlended(float roughness, float metallic, float alpha) {
  float coat = 2.0f * floor(roughness * kBlendedRoughnessSteps + 0.5f) + floor(metallic + 0.5f);
  return -1.0f - coat - 2.0f * (kBlendedRoughnessSteps + 1.0f) * floor(alpha * kAlphaSteps + 0.5f);
}
// Alpha of a code; 1 for surfaces that are not blended.
float AlphaOfCode(float code) {
  return code < 0.0f
             ? floor((-1.0f - code) / (2.0f * (kBlendedRoughnessSteps + 1.0f))) / kAlphaSteps
             : 1.0f;
}
// Roughness and metallic of a code.
vec2 CoatOfCode(float code) {
  bool blended = code < 0.0f;
  float steps = blended ? 2.0f : kMetallicSteps + 1.0f;
  float coat = blended ? mod(-1.0f - code, 2.0f * (kBlendedRoughnessSteps + 1.0f)) : code;
  float roughness = floor(coat / steps);
  return vec2(roughness / (blended ? kBlendedRoughnessSteps : kRoughnessSteps),
              (coat - roughness * steps) / (steps - 1.0f));
}

#endif
