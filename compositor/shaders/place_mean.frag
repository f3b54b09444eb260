#version 450 core
// A place's share of the virtual image. The means of compositor/passes/place_mean.h are sums of it.

layout(binding = 0) uniform sampler2D u_ratio;
layout(binding = 1) uniform sampler2D u_objects;
uniform float u_weight;

layout(location = 0) out vec4 out_ratio;
layout(location = 1) out vec4 out_objects;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  out_ratio = u_weight * texelFetch(u_ratio, pixel, 0);
  out_objects = u_weight * texelFetch(u_objects, pixel, 0);
}
