#version 450 core
// Shadow-catcher ratio as in shadow_ratio.frag, for triangles with known sun visibility:
// AffectedTriangles::kLinearSky of compositor/surfaces/affected_triangles.h. AIRLIGHT: the airlight
// in front of the surface is noticeable. BLENDED: some objects are seen through.

#include "compositor/shaders/aerial_perspective.glsl"
#include "compositor/shaders/linear_shadow_ratio.glsl"
#include "compositor/shaders/uncovered_samples.glsl"
#include "compositor/shaders/visibility_buffer_layout.glsl"

uniform vec3 u_eye_m;     // Centre of projection, marker coordinates.
uniform vec3 u_ray;       // As in visible_surface.glsl.
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;

layout(location = 0) out vec4 out_ratio;

layout(binding = 0) uniform usampler2D u_visible;  // From affected_pixels.frag.
layout(binding = 19) uniform usampler2D u_weights;
layout(binding = 1) uniform sampler2D u_linear_ratios;  // kTexelsPerLinearRatio per triangle.

LinearRatioPoint PlaceOn(uint id) {
  ivec2 at = TexelOfLinearRatio(int(max(id, 1u)) - 1);
  vec3 ray = u_ray + gl_FragCoord.x * u_ray_x + gl_FragCoord.y * u_ray_y;
  return LinearRatioAlong(u_eye_m, ray, texelFetch(u_linear_ratios, at, 0),
                     texelFetch(u_linear_ratios, at + ivec2(1, 0), 0),
                     texelFetch(u_linear_ratios, at + ivec2(2, 0), 0),
                     texelFetch(u_linear_ratios, at + ivec2(3, 0), 0),
                     texelFetch(u_linear_ratios, at + ivec2(4, 0), 0));
}

void main() {
  uvec4 seen = texelFetch(u_visible, ivec2(gl_FragCoord.xy), 0);
  uint weights = texelFetch(u_weights, ivec2(gl_FragCoord.xy), 0).r;
  vec3 ratio = vec3(0.0), airlight = vec3(0.0);
  float affected = 0.0;
  do {
    float weight = WeightOf(weights);
    LinearRatioPoint place = PlaceOn(IdOf(seen.x));
    ratio += weight * place.ratio;
    airlight += weight * AirlightOver(place.ratio, AirUpTo(distance(u_eye_m, place.position_m)));
    affected += weight;
    seen = uvec4(seen.yzw, 0u);
    weights >>= 8;
  } while (seen.x != 0u);
  out_ratio = vec4(RatioOfPixel(ratio, affected), 1.0);
  WriteAirlight(WeightOfUncovered() * airlight);
}
