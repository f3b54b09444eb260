#version 450 core
// What the virtual objects change of a real surface's light in a pixel as phantom_ratio.frag does,
// where the pixel shows one sheet alone and the sun's part in it is known of the whole triangle:
// ChangingTriangles::kSteadySky of compositor/changing_triangles.h.
// HAZE: so far away that the air before the surface counts.

#include "compositor/shaders/air_before_surface.glsl"
#include "compositor/shaders/steady_ratio.glsl"
#include "compositor/shaders/triangle_layout.glsl"

uniform float u_samples;  // A pixel.
uniform vec3 u_eye_m;     // Centre of projection, marker coordinates.
uniform vec3 u_ray;       // As in seen_surface.glsl.
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;

layout(location = 0) out vec4 out_ratio;

layout(binding = 0) uniform usampler2D u_seen;   // Of changing_pixels.frag.
layout(binding = 1) uniform sampler2D u_steady;  // kTexelsASteady by triangle.

SteadyPlace PlaceOn(uint id) {
  ivec2 at = TexelOfSteady(int(max(id, 1u)) - 1);
  vec3 ray = u_ray + gl_FragCoord.x * u_ray_x + gl_FragCoord.y * u_ray_y;
  return SteadyAlong(u_eye_m, ray, texelFetch(u_steady, at, 0),
                     texelFetch(u_steady, at + ivec2(1, 0), 0),
                     texelFetch(u_steady, at + ivec2(2, 0), 0),
                     texelFetch(u_steady, at + ivec2(3, 0), 0),
                     texelFetch(u_steady, at + ivec2(4, 0), 0));
}

void main() {
  uint seen = texelFetch(u_seen, ivec2(gl_FragCoord.xy), 0).x;
  float count = dot(SamplesOf(seen), vec4(1.0));
  SteadyPlace place = PlaceOn(IdOf(seen));
  vec3 haze = HazeOver(place.ratio, AirUpTo(distance(u_eye_m, place.position_m)));
  // The other samples show what does not change, or objects.
  out_ratio = vec4((count * place.ratio + (u_samples - count)) / u_samples, 1.0);
  DrawHaze(count * haze / u_samples);
}
