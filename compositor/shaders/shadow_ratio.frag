#version 450 core
// Shadow-catcher ratio of a pixel (differential.glsl): the mean over its samples, 1 where an object
// is in front. Each component of a surface (affected_pixels.frag) is shaded once. SUN_MAY_CHANGE or
// SKY_CHANGES selects the kind of change: compositor/surfaces/affected_triangles.h.
// linear_shadow_ratio.frag handles triangles that need no shadow lookup. AIRLIGHT: the airlight in
// front of the surface is noticeable. BLENDED: some objects are seen through.

#include "compositor/shaders/aerial_perspective.glsl"
#include "compositor/shaders/differential.glsl"
#include "compositor/shaders/sun_seen.glsl"
#include "compositor/shaders/uncovered_samples.glsl"
#include "compositor/shaders/visible_surface.glsl"
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#endif
#include "shadows/shaders/shadow_visibility.glsl"

uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.

layout(location = 0) out vec4 out_ratio;

layout(binding = 0) uniform usampler2D u_visible;  // From affected_pixels.frag.
layout(binding = 19) uniform usampler2D u_weights;

struct Change {
  vec3 ratio;
  vec3 airlight;  // Display-linear.
};

Change ChangeOf(VisibleSurface surface, int component) {
  FogAir air = AirUpTo(distance(u_eye_m, surface.position_m));
  vec3 sun = max(dot(surface.normal, u_to_sun), 0.0) * u_sun_normal_lux;
  sun *= CloudTransmittance(surface.position_m);
  float visibility_phantoms = ShadowVisibility(0, surface.position_m, surface.flat_normal,
                                               surface.step_x, surface.step_y);
  // Permutations, not tests: Mesa's software renderer executes an `if` regardless of its condition.
#ifdef SUN_MAY_CHANGE
  float visibility_all = ShadowVisibility(1, surface.position_m, surface.flat_normal,
                                          surface.step_x, surface.step_y);
  float seen = SunTransmittanceSeen(surface, component, sun.g * visibility_phantoms, air);
  visibility_phantoms *= seen;
  visibility_all *= seen;
#else
  float visibility_all = visibility_phantoms;
#endif
  Change change;
  change.ratio = DifferentialRatio(surface.ambient_with, surface.ambient_without, sun,
                                   visibility_all, visibility_phantoms);
  change.airlight = AirlightOver(change.ratio, air);
  return change;
}

void main() {
  uvec4 seen = texelFetch(u_visible, ivec2(gl_FragCoord.xy), 0);
  uint weights = texelFetch(u_weights, ivec2(gl_FragCoord.xy), 0).r;
  vec3 ratio = vec3(0.0), airlight = vec3(0.0);
  float affected = 0.0;
  do {
    float weight = WeightOf(weights);
    uvec4 triangle = TriangleOf(IdOf(seen.x));
    Change change = ChangeOf(VisibleSurfaceOf(VertexOf(triangle.x), VertexOf(triangle.y),
                                         VertexOf(triangle.z), gl_FragCoord.xy),
                             int(ComponentOf(triangle)));
    ratio += weight * change.ratio;
    airlight += weight * change.airlight;
    affected += weight;
    seen = uvec4(seen.yzw, 0u);
    weights >>= 8;
  } while (seen.x != 0u);
  out_ratio = vec4(RatioOfPixel(ratio, affected), 1.0);
  WriteAirlight(WeightOfUncovered() * airlight);
}
