#version 450 core
// Composites the virtual objects into the camera image, one invocation per camera pixel.
//
// CAMERA_RESPONSE: pixel values follow the camera's own response, by table, instead of sRGB. GRAIN:
// drawn pixels receive the camera's noise. COARSE_RATIO: the ratio is on the grid of
// compositor/passes/coarse_ratio.h, and there is no object. SAME_PIXELS: render pixels are camera
// pixels. OCCLUDED: real surfaces cover objects over a part of the lens
// (compositor/lens/real_occluders.h). INK: real surfaces carry ink (compositor/passes/ink_images.h).
// INK_ALONE: and nothing else changes.

#include "compositor/shaders/srgb_transfer.glsl"

layout(binding = 0) uniform sampler2D u_background;  // Pixel values / 255, row 0 = top.
// Mean of differential.glsl over a pixel's samples, 1 where an object covers them. Render image.
layout(binding = 1) uniform sampler2D u_ratio;
layout(binding = 2) uniform sampler2D u_objects;      // Premultiplied display-linear, coverage.
#ifndef SAME_PIXELS
layout(binding = 3) uniform sampler2D u_positions;    // RenderPositions(), texels.
#endif

layout(location = 0) out vec4 out_encoded;

#ifdef CAMERA_RESPONSE
layout(binding = 4) uniform sampler2D u_light_of_pixel_value;  // At sixteenths of 8-bit values.
// Evenly spaced in the square root of light.
layout(binding = 5) uniform sampler2D u_pixel_value_of_light;

vec3 LinearFromEncoded(vec3 encoded) {
  ivec3 code = ivec3(encoded * 4080.0 + 0.5);
  return vec3(texelFetch(u_light_of_pixel_value, ivec2(code.r, 0), 0).r,
              texelFetch(u_light_of_pixel_value, ivec2(code.g, 0), 0).g,
              texelFetch(u_light_of_pixel_value, ivec2(code.b, 0), 0).b);
}

vec3 EncodedFromLinear(vec3 light) {
  float size = float(textureSize(u_pixel_value_of_light, 0).x);
  vec3 at = (sqrt(clamp(light, 0.0, 1.0)) * (size - 1.0) + 0.5) / size;
  return vec3(texture(u_pixel_value_of_light, vec2(at.r, 0.5)).r,
              texture(u_pixel_value_of_light, vec2(at.g, 0.5)).g,
              texture(u_pixel_value_of_light, vec2(at.b, 0.5)).b);
}
#else
vec3 LinearFromEncoded(vec3 encoded) { return LinearFromSrgb(encoded); }
vec3 EncodedFromLinear(vec3 light) { return SrgbFromLinear(light); }
#endif

#ifdef OCCLUDED
// Light behind the objects, and the share of the lens that real surfaces before them cover.
layout(binding = 7) uniform sampler2D u_behind_objects;
layout(binding = 8) uniform sampler2D u_occluders;  // Their light.
#endif

#ifdef INK
layout(binding = 9) uniform sampler2D u_ink_kept;  // Render image.
layout(binding = 10) uniform sampler2D u_ink_lit;
layout(binding = 11) uniform sampler2D u_ink_unlit;
#endif

#ifdef GRAIN
layout(binding = 6) uniform sampler2D u_grain;  // MakeGrain(): one channel common to all, one for each.
uniform ivec2 u_grain_offset;
uniform vec3 u_noise_constant;  // Variance of linear light = constant + slope * light.
uniform vec3 u_noise_slope;
uniform float u_channel_correlation;

/// Noise to add for the variance of `light`. The noise of `behind` times `kept` is already there.
vec3 MissingGrain(ivec2 pixel, vec3 light, vec3 behind, vec3 kept) {
  vec4 grain = texelFetch(u_grain, (pixel + u_grain_offset) % textureSize(u_grain, 0), 0);
  vec3 unit = sqrt(u_channel_correlation) * grain.aaa + sqrt(1.0 - u_channel_correlation) * grain.rgb;
  vec3 there = kept * kept * (u_noise_constant + u_noise_slope * behind);
  vec3 wanted = u_noise_constant + u_noise_slope * max(light, vec3(0.0));
  return unit * sqrt(max(wanted - there, vec3(0.0)));
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 background = texelFetch(u_background, pixel, 0);
#ifdef SAME_PIXELS
  vec2 position = gl_FragCoord.xy;
#else
  vec2 position = texelFetch(u_positions, pixel, 0).xy;
#endif
#ifdef COARSE_RATIO
  const float kStep_px = 4.0;
  vec4 object = vec4(0.0);
  vec3 ratio = texture(u_ratio, position / (kStep_px * vec2(textureSize(u_ratio, 0)))).rgb;
#elif defined(INK_ALONE)
  vec2 at = position / vec2(textureSize(u_ink_kept, 0));
  vec4 object = vec4(0.0);
  vec3 ratio = vec3(1.0);
#elif defined(SAME_PIXELS)
  vec4 object = texelFetch(u_objects, pixel, 0);
  vec3 ratio = texelFetch(u_ratio, pixel, 0).rgb;
#else
  vec2 at = position / vec2(textureSize(u_objects, 0));
  vec4 object = texture(u_objects, at);
  vec3 ratio = texture(u_ratio, at).rgb;
#endif
  bool untouched = object.a == 0.0 && ratio == vec3(1.0);
#ifdef INK
#ifdef SAME_PIXELS
  vec3 ink_kept = texelFetch(u_ink_kept, pixel, 0).rgb;
  vec3 ink_lit = texelFetch(u_ink_lit, pixel, 0).rgb;
  vec3 ink_unlit = texelFetch(u_ink_unlit, pixel, 0).rgb;
#else
  vec3 ink_kept = texture(u_ink_kept, at).rgb;
  vec3 ink_lit = texture(u_ink_lit, at).rgb;
  vec3 ink_unlit = texture(u_ink_unlit, at).rgb;
#endif
  untouched = untouched && ink_kept == vec3(1.0) && ink_lit + ink_unlit == vec3(0.0);
#endif
  if (untouched) {
    out_encoded = background;
    return;
  }
  vec3 camera = LinearFromEncoded(background.rgb);
  vec3 behind = camera;
  vec3 kept = max(ratio - object.a, 0.0);  // Zero where the object covers the pixel.
#ifdef INK
  behind = camera * ink_kept + ink_lit;
#endif
  vec3 light = behind * kept + object.rgb;
#ifdef INK
  light += (1.0 - object.a) * ink_unlit;
#endif
#ifdef OCCLUDED
  // The frame's light is that of occluder and background. The object replaces the background alone,
  // by its share of the lens.
  vec2 in_render = position / vec2(textureSize(u_objects, 0));
  vec4 replaced = texture(u_behind_objects, in_render);
  vec3 light_kept = object.a < 0.999 ? kept / (1.0 - object.a) : vec3(1.0);
  vec3 with_occluder = light + object.a * light_kept * (behind - replaced.rgb);
  with_occluder = max(with_occluder, replaced.a * texture(u_occluders, in_render).rgb);
  light = replaced.a > 0.0 ? with_occluder : light;
#endif
#ifdef GRAIN
#ifdef INK
  light += MissingGrain(pixel, light, camera, kept * ink_kept);
#else
  light += MissingGrain(pixel, light, camera, kept);
#endif
#endif
  out_encoded = vec4(EncodedFromLinear(light), 1.0);
}
