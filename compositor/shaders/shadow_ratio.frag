#version 450 core
// What the virtual objects change of the real surfaces' light in a pixel, see differential.glsl: the
// mean over its samples, 1 where an object is in front, each component of a surface
// (affected_pixels.frag) shaded once. Drawn with SUN_MAY_CHANGE or SKY_CHANGES:
// compositor/surfaces/affected_triangles.h. Where nothing need be asked of the sun, linear_shadow_ratio.frag.
// AIRLIGHT: so far away that the air before the surface counts.

#include "compositor/shaders/aerial_perspective.glsl"
#include "compositor/shaders/differential.glsl"
#include "compositor/shaders/visible_surface.glsl"
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#endif
#include "shadows/shaders/shadow_visibility.glsl"

uniform float u_samples;        // A pixel.
uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.

layout(location = 0) out vec4 out_ratio;

layout(binding = 0) uniform usampler2D u_visible;  // Of affected_pixels.frag.

#ifdef SUN_MAY_CHANGE
#include "compositor/shaders/sun_transmittance_map.glsl"

uniform float u_assumes_unmodelled_shadows;           // 1; 0 where nothing but phantoms shades: each lies in the sun.
uniform float u_margin_half_m;    // The marker's board lies here: white and black, not the ground.

/// How much of the sun the picture shows on a surface that the model has in the sun: trees and all
/// that no phantom stands for shade it too, and what is shaded already no virtual shadow darkens
/// again. Green alone, over about three pixels, so that a surface's grain does not count. From half
/// the sun on all of it counts: patterns are darker than their mean, too. On the marker's board the
/// map says it, which the white around the marker and the ground about it fill.
float SunTransmittanceSeen(VisibleSurface surface, int component, float sun, FogAir air) {
  const float kPi = 3.14159265;
  const float kShaded = 0.08, kHalf = 0.35, kLit = 0.70;
  vec3 position_m = surface.position_m;
  float green_albedo = u_assumes_unmodelled_shadows * ValueOfComponent(component);  // 0: not known.
  bool on_margin = max(abs(position_m.x), abs(position_m.y)) < u_margin_half_m &&
                  abs(position_m.z) < 0.25 * u_margin_half_m;
  vec2 size = vec2(textureSize(u_background, 0));
  vec2 at = texelFetch(u_camera_positions, ivec2(gl_FragCoord.xy), 0).xy;
  float light = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 aside = vec2((i & 1) == 0 ? -0.8 : 0.8, (i & 2) == 0 ? -0.8 : 0.8);
    float code = texture(u_background, (at + aside) / size).g * 255.0;
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
  float visibility_phantoms = ShadowVisibility(0, surface.position_m, surface.flat_normal,
                                               surface.step_x, surface.step_y);
  // Permutations, not tests: Mesa's software renderer runs an `if` whatever its condition.
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
  vec3 ratio = vec3(0.0), airlight = vec3(0.0);
  float samples = 0.0;
  do {
    float count = dot(SamplesOf(seen.x), vec4(1.0));
    uvec4 triangle = TriangleOf(IdOf(seen.x));
    Change change = ChangeOf(VisibleSurfaceOf(VertexOf(triangle.x), VertexOf(triangle.y),
                                         VertexOf(triangle.z), gl_FragCoord.xy),
                             int(ComponentOf(triangle)));
    ratio += count * change.ratio;
    airlight += count * change.airlight;
    samples += count;
    seen = uvec4(seen.yzw, 0u);
  } while (seen.x != 0u);
  // The others show what does not change, or objects.
  out_ratio = vec4((ratio + (u_samples - samples)) / u_samples, 1.0);
  WriteAirlight(airlight / u_samples);
}
