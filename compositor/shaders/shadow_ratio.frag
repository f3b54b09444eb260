#version 450 core
// Shadow-catcher ratio of a pixel (differential.glsl): the mean over its samples, 1 where an object
// is in front. Each component of a surface (affected_pixels.frag) is shaded once. SUN_MAY_CHANGE or
// SKY_CHANGES selects the kind of change: compositor/surfaces/affected_triangles.h.
// linear_shadow_ratio.frag handles triangles that need no shadow lookup. AIRLIGHT: the airlight in
// front of the surface is noticeable. BLENDED: some objects are seen through.

#include "compositor/shaders/aerial_perspective.glsl"
#include "compositor/shaders/differential.glsl"
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

#include "compositor/shaders/sun_transmittance_map.glsl"

#ifdef SUN_MAY_CHANGE
uniform float u_assumes_unmodelled_shadows;  // 1; 0 where only phantoms cast shadows.
// Half of the white margin's edge. There the albedo is not that of the ground.
uniform float u_margin_half_m;

/// Estimates the sun transmittance from the image, on a surface that the model has in the sun.
/// Unmodelled geometry such as trees may shade it, and a virtual shadow must not darken shaded
/// parts again. Only green is used, over about three pixels, to suppress the surface's texture.
/// From about half of the sun on, all of it counts, because patterns are darker than their mean,
/// too. On the marker and its white margin the map gives the transmittance. It is filled by the
/// white around the marker and the ground around it.
float SunTransmittanceSeen(VisibleSurface surface, int component, float sun, FogAir air) {
  const float kPi = 3.14159265;
  const float kShaded = 0.08, kHalf = 0.35, kLit = 0.70;
  vec3 position_m = surface.position_m;
  float green_albedo = u_assumes_unmodelled_shadows * ValueOfComponent(component);  // 0: unknown.
  bool on_margin = max(abs(position_m.x), abs(position_m.y)) < u_margin_half_m &&
                  abs(position_m.z) < 0.25 * u_margin_half_m;
  vec2 size = vec2(textureSize(u_background, 0));
  vec2 at = texelFetch(u_camera_positions, ivec2(gl_FragCoord.xy), 0).xy;
  float light = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 aside = vec2((i & 1) == 0 ? -0.8 : 0.8, (i & 2) == 0 ? -0.8 : 0.8);
    float code = texture(u_background, (at + aside) / size).g * 4080.0;
    light += 0.25 * texelFetch(u_light_of_pixel_value, ivec2(int(code + 0.5), 0), 0).g;
  }
  float radiance = max(light / max(u_exposure_scale.g, 1e-12) - air.light.g, 0.0) / air.left.g;
  float irradiance = kPi * radiance / max(green_albedo, 1e-6);
  float share = (irradiance - surface.ambient_without.g) / max(sun, 1e-6);
  float seen = mix(clamp(share - kShaded, 0.0, 1.0), 1.0, smoothstep(kHalf, kLit, share));
  return on_margin ? SunTransmittance(position_m) : (green_albedo == 0.0 ? 1.0 : seen);
}
#endif

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
