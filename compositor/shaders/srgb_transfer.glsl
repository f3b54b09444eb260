#ifndef COMPOSITOR_SRGB_TRANSFER_GLSL
#define COMPOSITOR_SRGB_TRANSFER_GLSL
// IEC 61966-2-1:1999; must match base/srgb.h. Also compiled as C++ (tests/compositor).

vec3 LinearFromSrgb(vec3 encoded) {
  return mix(pow((encoded + 0.055f) / 1.055f, vec3(2.4f)), encoded / 12.92f,
             lessThanEqual(encoded, vec3(0.04045f)));
}

vec3 SrgbFromLinear(vec3 linear) {
  vec3 clipped = clamp(linear, 0.0f, 1.0f);
  return mix(1.055f * pow(clipped, vec3(1.0f / 2.4f)) - 0.055f, 12.92f * clipped,
             lessThanEqual(clipped, vec3(0.0031308f)));
}

#endif
