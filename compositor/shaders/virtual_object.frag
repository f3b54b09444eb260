#version 450 core
// Shades the virtual objects of a pixel: display-linear color summed over the samples, and their
// coverage. Each piece of surface (object_pixels.frag) is shaded once. NO_SUN: everything that the
// pixel shows faces away from the sun.
//
// TEXTURED: triangle_id.frag sampled textures. GLOSSY: some objects are glossy. This is a
// permutation, not a test, because Mesa's software renderer executes an `if` regardless of its
// condition.

#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/ggx.glsl"
#include "compositor/shaders/sun_transmittance_map.glsl"
#include "compositor/shaders/visible_surface.glsl"
#include "compositor/shaders/material_table.glsl"
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#endif
#include "shadows/shaders/shadow_visibility.glsl"

uniform float u_samples;  // Per pixel.
uniform vec3 u_to_sun;           // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;   // Linear Rec.709.
uniform vec3 u_exposure_scale;             // Display-linear value per radiance.

uniform float u_fog_split_m[kFogSplits];  // FogSplits of compositor/passes/aerial_fog.h.
uniform vec3 u_fog_optical_depth[kFogSplits];
uniform vec3 u_fog_inscattered[kFogSplits];

layout(binding = 0) uniform usampler2D u_visible;  // From object_pixels.frag.
#ifdef GLOSSY
layout(binding = 3) uniform sampler2DArray u_environment;  // EnvironmentMap, one layer per roughness.
uniform vec3 u_sky_mix, u_below_mix;  // Strength above and below the horizon, by the frame's light.
uniform vec3 u_up;                    // Unit, marker coordinates.
#endif
#ifdef TEXTURED
#include "compositor/shaders/texel_code.glsl"
layout(binding = 4) uniform sampler2DMS u_texels;
#endif

layout(location = 0) out vec4 out_color;

#ifdef TEXTURED
// Multiplies the material by its textures: the mean of the samples that show the piece.
MaterialRecord Textured(MaterialRecord record, vec4 samples) {
  vec3 color = vec3(0.0);
  vec2 coat = vec2(0.0);
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  for (int i = 0; i < int(u_samples); ++i) {
    vec4 texel = texelFetch(u_texels, pixel, i);
    color += samples[i] * texel.rgb;
    coat += samples[i] * CoatOfCode(texel.a);
  }
  float share = 1.0 / max(dot(samples, vec4(1.0)), 1.0);
  record.base_color *= color * share;
  record.roughness *= coat.x * share;
  record.metallic *= coat.y * share;
  return record;
}
#endif

#ifdef GLOSSY
vec3 PrefilteredEnvironment(vec3 direction, float roughness) {
  vec2 uv = vec2(atan(direction.y, direction.x) / (2.0 * kPi) + 0.5,
                 acos(clamp(direction.z, -1.0, 1.0)) / kPi);
  // Repeated around the horizon, but the zenith must not receive the nadir's light.
  float half_row = 0.5 / float(textureSize(u_environment, 0).y);
  uv.y = clamp(uv.y, half_row, 1.0 - half_row);
  float level = roughness * float(textureSize(u_environment, 0).z - 1);
  // Explicit level: the next pixel may show another surface, and the direction jumps at ±π.
  vec3 low = textureLod(u_environment, vec3(uv, floor(level)), 0.0).rgb;
  vec3 high = textureLod(u_environment, vec3(uv, ceil(level)), 0.0).rgb;
  // A rough reflection sees both sides of the horizon.
  float width = max(roughness, 0.02);
  vec3 strength = mix(u_below_mix, u_sky_mix, smoothstep(-width, width, dot(direction, u_up)));
  return strength * mix(low, high, fract(level));
}

// Specular reflection of the sun and the environment by metals and coats. `sun` includes the
// surface's cosine.
vec3 MirroredRadiance(VisibleSurface surface, MaterialRecord record, vec3 sun) {
  vec3 normal = surface.normal;
  vec3 to_eye = normalize(u_eye_m - surface.position_m);
  vec3 f0 = mix(vec3(record.dielectric_f0), record.base_color, record.metallic);
  float n_dot_v = max(dot(normal, to_eye), 1e-4);
  vec3 radiance = vec3(0.0);
#ifndef NO_SUN
  vec3 half_vector = normalize(to_eye + u_to_sun);
  float alpha = max(record.roughness * record.roughness, 1e-3);
  vec3 specular = FresnelSchlick(max(dot(to_eye, half_vector), 0.0), f0) *
                  (DistributionGgx(max(dot(normal, half_vector), 0.0), alpha) *
                   VisibilitySmith(n_dot_v, max(dot(normal, u_to_sun), 1e-4), alpha));
  radiance += specular * sun;
#endif
  // Phantoms and objects occlude the reflected sky as much as the whole incident light.
  vec3 open = max(PrefilteredEnvironment(normal, 1.0) * kPi, vec3(1e-6));
  radiance += EnvironmentBrdf(f0, record.roughness, n_dot_v) *
              PrefilteredEnvironment(reflect(-to_eye, normal), record.roughness) *
              clamp(surface.ambient_with / open, 0.0, 2.0);
  return max(max(f0.r, f0.g), f0.b) > 0.0 ? radiance : vec3(0.0);
}
#endif

vec3 ColorOf(VisibleSurface surface, MaterialRecord record) {
#ifdef NO_SUN
  vec3 sun = vec3(0.0);
#else
  float n_dot_l = max(dot(surface.normal, u_to_sun), 0.0);
  // A coarse mesh with smooth normals represents a curved surface. The sun shines on that, also
  // where its triangles already face away.
  vec3 lift = surface.lift + surface.ambient_without;
  bool curved = dot(lift, surface.normal) > 0.0 &&
                dot(surface.normal, u_to_sun) > dot(surface.flat_normal, u_to_sun);
  float visibility = ShadowVisibility(1, surface.position_m + lift,
                                      curved ? surface.normal : surface.flat_normal, surface.step_x,
                                      surface.step_y);
  visibility *= SunTransmittance(surface.position_m);
  vec3 sun = u_sun_normal_lux * (visibility * n_dot_l);
#endif

  vec3 diffuse = record.base_color * (1.0 - record.metallic) * record.base_under_coat;
  vec3 radiance = diffuse * (sun + surface.ambient_with) / kPi;

#ifdef GLOSSY
  radiance += MirroredRadiance(surface, record, sun);
#endif
  FogAir air = FogUpTo(distance(u_eye_m, surface.position_m), u_fog_split_m, u_fog_optical_depth,
                       u_fog_inscattered);
  return u_exposure_scale * (radiance * air.left + air.light);
}

void main() {
  uvec4 seen = texelFetch(u_visible, ivec2(gl_FragCoord.xy), 0);
  vec4 sum = vec4(0.0);
  do {
    vec4 samples = SamplesOf(seen.x);
    uvec4 triangle = TriangleOf(IdOf(seen.x));
    MaterialRecord record = RecordOf(int(ValueOfComponent(int(ComponentOf(triangle)))));
    VisibleSurface surface =
        VisibleSurfaceOf(Moved(VertexOf(triangle.x), record), Moved(VertexOf(triangle.y), record),
                    Moved(VertexOf(triangle.z), record), gl_FragCoord.xy);
#ifdef TEXTURED
    record = Textured(record, samples);
#endif
    sum += dot(samples, vec4(1.0)) * vec4(ColorOf(surface, record), 1.0);
    seen = uvec4(seen.yzw, 0u);
  } while (seen.x != 0u);
  out_color = sum / u_samples;
}
