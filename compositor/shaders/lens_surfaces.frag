#version 450 core
// Reciprocal distances of what a pixel shows: the nearest object, the nearest and the farthest real
// surface. 0: there is none, or it is not known. The nearest real surface has a part of all real
// ones.

#include "compositor/shaders/lens_depth.glsl"
#include "compositor/shaders/visibility_buffer_layout.glsl"

layout(binding = 3) uniform usampler2DMS u_ids;

layout(location = 0) out vec4 out_dioptres;  // Object, real: nearest, its part, farthest.

// Samples from that part of the nearest 1/z on belong to the nearest surface.
const float kSame = 0.98;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float object = 0.0, nearest = 0.0, farthest = 1e30, real = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    float depth = texelFetch(u_sample_depth, pixel, i).r;
    float dioptres = depth < 1.0 ? DioptresOf(depth) : 0.0;
    bool is_object = texelFetch(u_ids, pixel, i).r > kObjectBit;
    object = is_object ? max(object, dioptres) : object;
    nearest = is_object ? nearest : max(nearest, dioptres);
    farthest = is_object ? farthest : min(farthest, dioptres);
    real += is_object ? 0.0 : 1.0;
  }
  float near = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    float depth = texelFetch(u_sample_depth, pixel, i).r;
    bool is_object = texelFetch(u_ids, pixel, i).r > kObjectBit;
    near += !is_object && depth < 1.0 && DioptresOf(depth) >= kSame * nearest ? 1.0 : 0.0;
  }
  out_dioptres = vec4(object, nearest, nearest > 0.0 ? near / real : 1.0, min(farthest, nearest));
}
