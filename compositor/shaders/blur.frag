#version 450 core
// One direction of a separable Gaussian over the two virtual images, render pixels. Ratios without
// alpha are not drawn at full resolution; they are omitted.
// NO_OBJECTS: nothing within reach has been drawn into the objects' image.

layout(binding = 1) uniform sampler2D u_ratio;
layout(binding = 2) uniform sampler2D u_objects;

uniform ivec2 u_direction;     // (1, 0) or (0, 1).
uniform float u_sigma_px;
uniform int u_reach_px;

layout(location = 0) out vec4 out_ratio;
layout(location = 1) out vec4 out_objects;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(u_ratio, 0) - 1;
  vec4 ratio = vec4(0.0);
  vec4 objects = vec4(0.0);
  float weights = 0.0;
  for (int i = -u_reach_px; i <= u_reach_px; ++i) {
    float t = float(i) / u_sigma_px;
    float weight = exp(-0.5 * t * t);
    ivec2 at = clamp(pixel + i * u_direction, ivec2(0), last);
    vec4 here = texelFetch(u_ratio, at, 0);
    ratio += weight * here.a * vec4(here.rgb, 1.0);
#ifndef NO_OBJECTS
    objects += weight * texelFetch(u_objects, at, 0);
#endif
    weights += weight;
  }
  out_ratio = ratio / max(ratio.a, 1e-6);
  out_objects = objects / weights;
}
