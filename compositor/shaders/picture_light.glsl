#ifndef COMPOSITOR_PICTURE_LIGHT_GLSL
#define COMPOSITOR_PICTURE_LIGHT_GLSL
// Linear light of the camera image behind a render pixel.

layout(binding = 2) uniform sampler2D u_background;  // Pixel values / 255, row 0 = top.
layout(binding = 3) uniform sampler2D u_camera_positions;  // Camera texels, per render pixel.
layout(binding = 4) uniform sampler2D u_light_of_pixel_value;  // At sixteenths of 8-bit values.

// Display-linear, at this render pixel's position in the image.
vec3 PictureLight() {
  vec2 at = texelFetch(u_camera_positions, ivec2(gl_FragCoord.xy), 0).xy;
  ivec3 code = ivec3(texture(u_background, at / vec2(textureSize(u_background, 0))).rgb * 4080.0 + 0.5);
  return vec3(texelFetch(u_light_of_pixel_value, ivec2(code.r, 0), 0).r,
              texelFetch(u_light_of_pixel_value, ivec2(code.g, 0), 0).g,
              texelFetch(u_light_of_pixel_value, ivec2(code.b, 0), 0).b);
}

#endif
