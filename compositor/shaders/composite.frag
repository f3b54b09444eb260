#version 450 core
// The camera's picture with the virtual objects, one invocation a camera pixel.

#include "compositor/shaders/srgb_transfer.glsl"

layout(binding = 0) uniform sampler2D u_background;   // sRGB-encoded codes / 255, row 0 = top.
layout(binding = 1) uniform sampler2D u_ratio;        // differential.glsl, render picture.
layout(binding = 2) uniform sampler2D u_objects;      // Premultiplied display-linear, coverage.
layout(binding = 3) uniform sampler2D u_positions;    // RenderPositions(), texels.

layout(location = 0) out vec4 out_encoded;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 background = texelFetch(u_background, pixel, 0);
  vec2 at = texelFetch(u_positions, pixel, 0).xy / vec2(textureSize(u_objects, 0));
  vec4 object = texture(u_objects, at);
  vec3 ratio = texture(u_ratio, at).rgb;
  if (object.a == 0.0 && ratio == vec3(1.0)) {
    out_encoded = background;
    return;
  }
  vec3 behind = LinearFromSrgb(background.rgb) * ratio;
  out_encoded = vec4(SrgbFromLinear(behind * (1.0 - object.a) + object.rgb), 1.0);
}
