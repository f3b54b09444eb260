#version 450 core
// Reciprocal distances of what a pixel shows: the nearest object, the nearest and the farthest real
// surface. 0: there is none, or it is not known. The nearest real surface has a part of all real
// ones, the nearest object of all objects.

#include "compositor/shaders/lens_depth.glsl"
#include "compositor/shaders/visibility_buffer_layout.glsl"

layout(binding = 3) uniform usampler2DMS u_ids;

layout(location = 0) out vec4 out_dioptres;  // Object, real: nearest, its part, farthest.
layout(location = 1) out vec2 out_objects;   // The nearest object's part of all, the farthest.

// Samples from that part of the nearest 1/z on belong to the nearest surface.
const float kSame = 0.98;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float object = 0.0, nearest = 0.0, farthest = 1e30, real = 0.0;
  float farthest_object = 1e30, objects = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    float depth = texelFetch(u_sample_depth, pixel, i).r;
    float dioptres = depth < 1.0 ? DioptresOf(depth) : 0.0;
    bool is_object = texelFetch(u_ids, pixel, i).r > kObjectBit;
    object = is_object ? max(object, dioptres) : object;
    farthest_object = is_object ? min(farthest_object, dioptres) : farthest_object;
    objects += is_object ? 1.0 : 0.0;
    nearest = is_object ? nearest : max(nearest, dioptres);
    farthest = is_object ? farthest : min(farthest, dioptres);
    real += is_object ? 0.0 : 1.0;
  }
  float near = 0.0, near_objects = 0.0;
  for (int i = 0; i < u_samples; ++i) {
    float depth = texelFetch(u_sample_depth, pixel, i).r;
    bool is_object = texelFetch(u_ids, pixel, i).r > kObjectBit;
    float dioptres = DioptresOf(depth);
    near += !is_object && depth < 1.0 && dioptres >= kSame * nearest ? 1.0 : 0.0;
    near_objects += is_object && dioptres >= kSame * object ? 1.0 : 0.0;
  }
  out_dioptres = vec4(object, nearest, nearest > 0.0 ? near / real : 1.0, min(farthest, nearest));
  out_objects = vec2(objects > 0.0 ? near_objects / objects : 1.0, min(farthest_object, object));
}
