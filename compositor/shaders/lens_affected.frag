#version 450 core
// Range of reciprocal distances that a pixel shows, where virtual objects affect it. Elsewhere the
// first value is larger than the second.

#include "compositor/shaders/lens_depth.glsl"

layout(binding = 1) uniform sampler2D u_ratio;
layout(binding = 2) uniform sampler2D u_objects;

layout(location = 0) out vec2 out_range;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec2 range = vec2(1e30, -1e30);
  for (int i = 0; i < u_samples; ++i) {
    float depth = texelFetch(u_sample_depth, pixel, i).r;
    float dioptres = DioptresOf(depth);
    range = depth < 1.0 ? vec2(min(range.x, dioptres), max(range.y, dioptres)) : range;
  }
  bool affected = texelFetch(u_objects, pixel, 0) != vec4(0.0) ||
                  texelFetch(u_ratio, pixel, 0).rgb != vec3(1.0);
  out_range = affected ? range : vec2(1e30, -1e30);
}
