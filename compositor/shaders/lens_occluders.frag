#version 450 core
// The share that one place on the stop has of the coverage by real surfaces in front of objects.

#include "compositor/shaders/lens_depth.glsl"

layout(binding = 1) uniform sampler2D u_virtual;  // 1/z of the nearest objects; 0: no objects.
uniform float u_weight;

layout(location = 0) out float out_share;

// A real surface begins to count as an occluder where it is nearer by these parts of its distance.
// Between them is the ground at the foot of an object. There the frame shows what the object
// replaces, without any estimate.
const float kBegins = 0.02, kCounts = 0.04;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float object = texelFetch(u_virtual, pixel, 0).r;
  float share = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    float depth = texelFetch(u_sample_depth, pixel, i).r;
    float nearer = DioptresOf(depth) / max(object, 1e-9) - 1.0;
    share += depth < 1.0 ? smoothstep(kBegins, kCounts, nearer) : 0.0;
  }
  out_share = object > 0.0 ? u_weight / float(u_samples) * share : 0.0;
}
