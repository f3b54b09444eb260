#version 450 core
// What the virtual objects change of a real surface's light, see differential.glsl. Drawn with
// SUN_MAY_CHANGE, SKY_CHANGES or NO_SUN: compositor/changing_triangles.h.
// HAZE: so far away that the air before the surface counts.

#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/differential.glsl"
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#endif
#include "shadows/shaders/shadow_visibility.glsl"

in vec3 v_position_m;
in vec3 v_normal;
centroid in vec3 v_ambient_with;
centroid in vec3 v_ambient_without;

uniform vec3 u_to_sun;          // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;  // Linear Rec.709.

layout(location = 0) out vec4 out_ratio;
layout(location = 1) out vec4 out_color;  // HAZE: added to the picture, covering nothing.

layout(binding = 2) uniform sampler2D u_background;        // Codes / 255, row 0 = top.
layout(binding = 3) uniform sampler2D u_camera_positions;  // Of a render pixel, camera texels.
layout(binding = 4) uniform sampler2D u_light_of_code;     // 256 texels.
uniform vec3 u_gain;  // Display-linear value per radiance.

#ifdef HAZE
uniform vec3 u_eye_m;                     // Centre of projection, marker coordinates.
uniform float u_fog_split_m[kFogSplits];  // FogSplits of compositor/aerial_fog.h.
uniform vec3 u_fog_optical_depth[kFogSplits];
uniform vec3 u_fog_inscattered[kFogSplits];

vec3 PictureLight() {
  vec2 at = texelFetch(u_camera_positions, ivec2(gl_FragCoord.xy), 0).xy;
  ivec3 code = ivec3(texture(u_background, at / vec2(textureSize(u_background, 0))).rgb * 255.0 + 0.5);
  return vec3(texelFetch(u_light_of_code, ivec2(code.r, 0), 0).r,
              texelFetch(u_light_of_code, ivec2(code.g, 0), 0).g,
              texelFetch(u_light_of_code, ivec2(code.b, 0), 0).b);
}
#endif

#ifdef SUN_MAY_CHANGE
#include "compositor/shaders/seen_sunlight.glsl"

uniform float u_green_albedo;    // Of the surface; 0: not known.
uniform float u_board_half_m;    // The marker's board lies here: white and black, not the ground.

/// How much of the sun the picture shows on a surface that the model has in the sun: trees and all
/// that no phantom stands for shade it too, and what is shaded already no virtual shadow darkens
/// again. Green alone, over about three pixels, so that a surface's grain does not count. From half
/// the sun on all of it counts: patterns are darker than their mean, too. On the marker's board the
/// map says it, which the white around the print and the ground about it fill.
float SunSeen(vec3 position_m, float ambient, float sun, FogAir air) {
  const float kPi = 3.14159265;
  const float kShaded = 0.08, kHalf = 0.35, kLit = 0.70;
  bool on_board = max(abs(position_m.x), abs(position_m.y)) < u_board_half_m &&
                  abs(position_m.z) < 0.25 * u_board_half_m;
  vec2 size = vec2(textureSize(u_background, 0));
  vec2 at = texelFetch(u_camera_positions, ivec2(gl_FragCoord.xy), 0).xy;
  float light = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 aside = vec2((i & 1) == 0 ? -0.8 : 0.8, (i & 2) == 0 ? -0.8 : 0.8);
    float code = texture(u_background, (at + aside) / size).g * 255.0;
    light += 0.25 * texelFetch(u_light_of_code, ivec2(int(code + 0.5), 0), 0).g;
  }
  float radiance = max(light / max(u_gain.g, 1e-12) - air.light.g, 0.0) / air.left.g;
  float irradiance = kPi * radiance / max(u_green_albedo, 1e-6);
  float share = (irradiance - ambient) / max(sun, 1e-6);
  float seen = mix(clamp(share - kShaded, 0.0, 1.0), 1.0, smoothstep(kHalf, kLit, share));
  return on_board ? SeenSunlight(position_m) : (u_green_albedo == 0.0 ? 1.0 : seen);
}
#endif

void main() {
#ifdef HAZE
  FogAir air = FogUpTo(distance(u_eye_m, v_position_m), u_fog_split_m, u_fog_optical_depth,
                       u_fog_inscattered);
#else
  FogAir air = FogAir(vec3(1.0), vec3(0.0));
#endif
  // Permutations, not tests: Mesa's software renderer runs an `if` whatever its condition.
#ifdef NO_SUN
  vec3 sun = vec3(0.0);
  float visibility_phantoms = 0.0;
  float visibility_all = 0.0;
#else
  vec3 normal = normalize(v_normal);
  vec3 flat_normal = ShadowGeometricNormal(v_position_m, normal);
  vec3 step_x = dFdx(v_position_m);
  vec3 step_y = dFdy(v_position_m);
  vec3 sun = max(dot(normal, u_to_sun), 0.0) * u_sun_normal_lux;
  float visibility_phantoms = ShadowVisibility(0, v_position_m, flat_normal, step_x, step_y);
#ifdef SUN_MAY_CHANGE
  float visibility_all = ShadowVisibility(1, v_position_m, flat_normal, step_x, step_y);
  float seen = SunSeen(v_position_m, v_ambient_without.g, sun.g * visibility_phantoms, air);
  visibility_phantoms *= seen;
  visibility_all *= seen;
#else
  float visibility_all = visibility_phantoms;
#endif
#endif
  vec3 ratio = DifferentialRatio(v_ambient_with, v_ambient_without, sun, visibility_all,
                                 visibility_phantoms);
  out_ratio = vec4(ratio, 1.0);
#ifdef HAZE
  out_color = vec4(AirBeforeShadow(ratio, u_gain * air.light, PictureLight()), 0.0);
#else
  out_color = vec4(0.0);
#endif
}
