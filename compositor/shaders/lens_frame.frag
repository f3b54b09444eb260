#version 450 core
// Linear light of the camera image at a render pixel, with the share of occluders.

#include "compositor/shaders/picture_light.glsl"

layout(binding = 1) uniform sampler2D u_share;

layout(location = 0) out vec4 out_light;

void main() {
  out_light = vec4(PictureLight(), texelFetch(u_share, ivec2(gl_FragCoord.xy), 0).r);
}
