#version 450 core
// The share that one place on the stop has of the virtual image. The means of
// compositor/lens/lens_views.h are sums of it.

#include "compositor/shaders/lens_depth.glsl"
#include "compositor/shaders/visibility_buffer_layout.glsl"

layout(binding = 1) uniform sampler2D u_ratio;
layout(binding = 2) uniform sampler2D u_objects;
layout(binding = 3) uniform usampler2DMS u_ids;
uniform float u_weight;

layout(location = 0) out vec4 out_ratio;
layout(location = 1) out vec4 out_objects;
layout(location = 2) out vec2 out_distance;  // Sum of 1/z over samples of objects, their share.

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  out_ratio = u_weight * texelFetch(u_ratio, pixel, 0);
  out_objects = u_weight * texelFetch(u_objects, pixel, 0);
  vec2 distance = vec2(0.0);
  for (int i = 0; i < u_samples; ++i) {
    float dioptres = DioptresOf(texelFetch(u_sample_depth, pixel, i).r);
    bool object = texelFetch(u_ids, pixel, i).r > kObjectBit;
    distance += object ? vec2(dioptres, 1.0) : vec2(0.0);
  }
  out_distance = u_weight / float(u_samples) * distance;
}
