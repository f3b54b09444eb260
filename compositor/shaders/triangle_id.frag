#version 450 core
// Writes the visibility buffer: each sample's triangle number in a table of
// compositor/surfaces/visibility_buffer.h, from 1 on. 0: nothing that changes.
//
// OBJECT: the triangle belongs to a virtual object. TEXTURED: also writes the textures' base color,
// roughness and metallic. DETAILED: with the vertices' colors; also writes bumps and emission.
// ALPHA: writes only the samples that alpha covers. BY_PLACES: a part of each pixel is drawn, with
// textures as sharp. BEHIND: nearer surfaces than PixelPlace::behind are left out.

#include "compositor/shaders/visibility_buffer_layout.glsl"

uniform int u_first_id;
uniform int u_step;  // 1; 0 if a whole draw has one number.

layout(location = 0) out uint out_id;

#ifdef BEHIND
#include "compositor/shaders/dioptres.glsl"

layout(binding = 23) uniform sampler2D u_behind;  // 1/z, 1/m.
#endif

#ifdef TEXTURED
#include "compositor/shaders/texel_code.glsl"

in vec2 v_uv;
uniform float u_place_side;  // As in visible_surface.glsl.
#ifdef BY_PLACES
vec4 Texel(sampler2D map, vec2 uv) { return texture(map, uv, log2(u_place_side)); }
#else
vec4 Texel(sampler2D map, vec2 uv) { return texture(map, uv); }
#endif
layout(binding = 0) uniform sampler2D u_base_color_texture;
layout(binding = 1) uniform sampler2D u_metallic_roughness_texture;
layout(location = 1) out vec4 out_texel;

#ifdef DETAILED
#include "compositor/shaders/surface_gradient.glsl"

in vec3 v_position_m;
in vec2 v_second_uv;
in vec4 v_color;
layout(binding = 2) uniform sampler2D u_normal_texture;
layout(binding = 3) uniform sampler2D u_emission_texture;
uniform float u_normal_scale;  // 0: no normal map. Negative on the back of an open surface.
// TextureCoordinates: the matrix's rows; the offset, and 1 for the second set.
uniform vec4 u_coat_rows, u_normal_rows, u_emission_rows;
uniform vec3 u_coat_offset, u_normal_offset, u_emission_offset;
layout(location = 2) out vec4 out_gradient;
layout(location = 3) out vec4 out_emission;

vec2 Coordinates(vec4 rows, vec3 offset) {
  vec2 uv = mix(v_uv, v_second_uv, offset.z);
  return vec2(dot(rows.xy, uv), dot(rows.zw, uv)) + offset.xy;
}
#endif

#ifdef ALPHA
uniform int u_alpha;  // Material::Alpha: 0 ignored, 1 cut out, 2 blended.
uniform float u_opacity;
uniform float u_alpha_cutoff;
uniform int u_samples;  // Per pixel, 4 at most.
uniform int u_surface;  // Unique per surface.
uniform int u_pane;     // Number among blended surfaces, equal for both sides of one.

// Blended surfaces below this alpha cover half of the samples, and what they show is weighted by
// alpha (virtual_object.frag).
const float kMaxBlended = 0.995;

// Two of four samples. Two surfaces behind each other each hide a sample of their own, and what is
// behind both keeps one. Three surfaces hide one each, and what is behind them has none. Surfaces
// whose numbers are equal modulo three have the same samples, and the nearer one hides the other.
int SamplesOfBlended() { return 8 | 1 << (u_pane % 3); }

float AlphaAt(vec2 uv, vec2 step_x, vec2 step_y) {
  float alpha = u_opacity * textureGrad(u_base_color_texture, uv, step_x, step_y).a;
#ifdef DETAILED
  alpha *= v_color.a;
#endif
  return alpha;
}

// Ordered dither from 0 to 1, evenly spread over adjacent pixels (Bayer 1973).
float Dither(ivec2 pixel) {
  const int kBayer[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);
  return (float(kBayer[(pixel.x & 3) + 4 * (pixel.y & 3)]) + 0.5) / 16.0;
}

// Random first sample. The order differs per pixel and surface, so that one surface does not hide
// the next.
int FirstSample(ivec2 pixel) {
  uint h = uint(pixel.x) * 0x9E3779B1u + uint(pixel.y) * 0x85EBCA77u + uint(u_surface) * 0xC2B2AE3Du;
  h = (h ^ h >> 15u) * 0x2C1B3C6Du;
  return int(h >> 30u);
}

// PixelPlace::number and count.
uniform int u_place, u_places;

// Alpha is sampled at each sample position, as the mean over the sample's share of the pixel. The
// edges of cut-outs therefore stay as sharp with distance as those of surfaces. Where there are not
// four samples, blended surfaces cover as many as alpha exceeds thresholds (screen-door
// transparency). Cut-outs have one threshold. If texels are finer than the sample's share, alpha is
// already a coverage.
int SamplesCovered() {
  // For 4 per pixel, as in all renderers.
  const vec2 kPlaces[4] =
      vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 step_x = dFdx(v_uv), step_y = dFdy(v_uv);
  float side = u_place_side * inversesqrt(float(u_samples));  // Side of a sample's share of the pixel.
  int count = u_samples * u_places;
  float minified =
      clamp(textureQueryLod(u_base_color_texture, v_uv).y + log2(side), 0.0, 1.0);
  float dither = u_alpha == 2 ? Dither(pixel) : 0.5;
  int first = FirstSample(pixel), covered = 0;
  for (int i = 0; i < u_samples; ++i) {
    vec2 aside = u_samples == 1 ? vec2(0.0) : kPlaces[i] - 0.5;
    vec2 uv = v_uv + aside.x * step_x + aside.y * step_y;
    float alpha = AlphaAt(uv, side * step_x, side * step_y);
    float spread = (float((i + u_place + first) % count) + dither) / float(count);
    float threshold = u_alpha == 2 ? spread : mix(u_alpha_cutoff, spread, minified);
    covered |= alpha >= threshold || u_alpha == 0 ? 1 << i : 0;
  }
  return covered;
}
#endif
#endif

void main() {
  out_id = uint(u_first_id + u_step * gl_PrimitiveID);
#ifdef OBJECT
  out_id |= kObjectBit;
#endif
#ifdef TEXTURED
  vec4 texel = Texel(u_base_color_texture, v_uv);
#ifdef DETAILED
  texel.rgb *= v_color.rgb;
  vec2 coat =
      Texel(u_metallic_roughness_texture, Coordinates(u_coat_rows, u_coat_offset)).gb;
  vec2 at = Coordinates(u_normal_rows, u_normal_offset);
  vec3 bump = 2.0 * Texel(u_normal_texture, at).rgb - 1.0;
  out_gradient = vec4(
      u_normal_scale * SurfaceGradient(bump, dFdx(v_position_m), dFdy(v_position_m), dFdx(at), dFdy(at)),
      0.0);
  out_emission = Texel(u_emission_texture, Coordinates(u_emission_rows, u_emission_offset));
#else
  vec2 coat = Texel(u_metallic_roughness_texture, v_uv).gb;
#endif
  out_texel = vec4(texel.rgb, CodeOfCoat(coat.x, coat.y));
#ifdef ALPHA
  float alpha = AlphaAt(v_uv, dFdx(v_uv), dFdy(v_uv));
  bool blended = u_alpha == 2 && u_samples == 4 && alpha < kMaxBlended;
  int covered = SamplesCovered();
  if (blended) {
    out_texel.a = CodeOfBlended(coat.x, coat.y, alpha);
    covered = alpha * kAlphaSteps < 0.5 ? 0 : SamplesOfBlended();
  }
  if (covered == 0) discard;  // The mask has no effect where the pixel's center alone is drawn.
  gl_SampleMask[0] = covered;
#endif
#endif
#ifdef BEHIND
  float nearest = texelFetch(u_behind, ivec2(gl_FragCoord.xy), 0).r;
  if (DioptresOf(gl_FragCoord.z) > nearest) discard;
  // The two triangles of an open surface have the same depth. The side that faces the camera counts.
  gl_FragDepth = gl_FragCoord.z + (gl_FrontFacing ? 0.0 : 1e-6);
#endif
}
