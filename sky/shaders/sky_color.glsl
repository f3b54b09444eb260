// Colours of the skies: the twin of sky/color.h.
#ifndef PLEINAIR_SKY_COLOR_GLSL
#define PLEINAIR_SKY_COLOR_GLSL

float SkyLuminance(vec3 rgb) { return dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f)); }

// CIE XYZ to linear Rec.709 (IEC 61966-2-1, Annex F), no channel negative; SkyLuminance() of it is
// Y, whatever the gamut took.
vec3 SkyRgbFromXyz(vec3 xyz) {
  if (xyz.y <= 0.0f) return vec3(0.0f);
  vec3 rgb = max(vec3(3.2406f * xyz.x - 1.5372f * xyz.y - 0.4986f * xyz.z,
                      -0.9689f * xyz.x + 1.8758f * xyz.y + 0.0415f * xyz.z,
                      0.0557f * xyz.x - 0.2040f * xyz.y + 1.0570f * xyz.z),
                 vec3(0.0f));
  float luminance = SkyLuminance(rgb);
  if (luminance <= 0.0f) return vec3(0.0f);
  return rgb * (xyz.y / luminance);
}

// Chromaticity x, y and luminance to linear Rec.709.
vec3 SkyRgbFromXyY(vec3 color) {
  if (color.z <= 0.0f || color.y <= 0.0f) return vec3(0.0f);
  float scale = color.z / color.y;
  return SkyRgbFromXyz(
      vec3(color.x * scale, color.z, (1.0f - color.x - color.y) * scale));
}

#endif
