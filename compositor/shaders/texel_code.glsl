#ifndef COMPOSITOR_TEXEL_CODE_GLSL
#define COMPOSITOR_TEXEL_CODE_GLSL
// Roughness and metallic in one 16-bit floating-point number, whose integers are exact to 2048.
// Arithmetic only; also compiled as C++ (gl/glsl_as_cpp.h,
// tests/compositor/shaders/shader_twins_test.cc).

const float kRoughnessSteps = 127.0f, kMetallicSteps = 15.0f;

float CodeOfCoat(float roughness, float metallic) {
  return floor(roughness * kRoughnessSteps + 0.5f) * (kMetallicSteps + 1.0f) +
         floor(metallic * kMetallicSteps + 0.5f);
}
// Roughness and metallic of a code.
vec2 CoatOfCode(float code) {
  float roughness = floor(code / (kMetallicSteps + 1.0f));
  return vec2(roughness / kRoughnessSteps,
              (code - roughness * (kMetallicSteps + 1.0f)) / kMetallicSteps);
}

#endif
