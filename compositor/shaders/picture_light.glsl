#ifndef COMPOSITOR_PICTURE_LIGHT_GLSL
#define COMPOSITOR_PICTURE_LIGHT_GLSL
// The camera's picture as light, for what is shaded before it.

layout(binding = 2) uniform sampler2D u_background;        // Codes / 255, row 0 = top.
layout(binding = 3) uniform sampler2D u_camera_positions;  // Of a render pixel, camera texels.
layout(binding = 4) uniform sampler2D u_light_of_pixel_value;     // 256 texels.

// Display-linear, where the picture shows this pixel.
vec3 PictureLight() {
  vec2 at = texelFetch(u_camera_positions, ivec2(gl_FragCoord.xy), 0).xy;
  ivec3 code = ivec3(texture(u_background, at / vec2(textureSize(u_background, 0))).rgb * 255.0 + 0.5);
  return vec3(texelFetch(u_light_of_pixel_value, ivec2(code.r, 0), 0).r,
              texelFetch(u_light_of_pixel_value, ivec2(code.g, 0), 0).g,
              texelFetch(u_light_of_pixel_value, ivec2(code.b, 0), 0).b);
}

#endif
