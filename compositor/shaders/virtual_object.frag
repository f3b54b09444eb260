#version 450 core
// Shades the virtual objects of a pixel: display-linear color times coverage, and the
// coverage. Each piece of surface (object_pixels.frag) is shaded once. NO_SUN: everything that the
// pixel shows faces away from the sun.
//
// TEXTURED: triangle_id.frag sampled textures. DETAILED: and bumps and emission; some objects may be
// unlit. Needs TEXTURED and GLOSSY. TRANSLUCENT: some transmit light, or are leaves. Needs DETAILED.
// BLENDED: some are seen through, and the weight of what is beside objects is written. Needs
// TEXTURED. GLOSSY: some objects are glossy. This is a
// permutation, not a test, because Mesa's software renderer executes an `if` regardless of its
// condition.

#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/ggx.glsl"
#include "compositor/shaders/piece_weights.glsl"
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
layout(binding = 19) uniform usampler2D u_weights;  // As piece_weights.glsl; DonorPixel() by piece.
#ifdef GLOSSY
layout(binding = 3) uniform sampler2DArray u_environment;  // EnvironmentMap, one layer per roughness.
uniform vec3 u_sky_mix, u_below_mix;  // Strength above and below the horizon, by the frame's light.
uniform vec3 u_up;                    // Unit, marker coordinates.
#endif
#ifdef TEXTURED
#include "compositor/shaders/texel_code.glsl"
#include "compositor/shaders/texture_donor.glsl"
layout(binding = 4) uniform sampler2DMS u_texels;
#endif

#ifdef DETAILED
#include "compositor/shaders/sheen.glsl"
#include "compositor/shaders/surface_gradient.glsl"
#ifdef TRANSLUCENT
#include "compositor/shaders/leaf_gloss.glsl"
#endif
const float kClearcoatF0 = 0.04;  // KHR_materials_clearcoat.
layout(binding = 16) uniform sampler2DMS u_gradients;
layout(binding = 17) uniform sampler2DMS u_emissions;
#endif

layout(location = 0) out vec4 out_color;
#ifdef BLENDED
layout(location = 1) out float out_sample_weight;  // uncovered_samples.glsl.
#endif

#ifdef TEXTURED
// Multiplies the material by its textures: the mean of a pixel's samples that show the piece.
MaterialRecord Textured(MaterialRecord record, ivec2 pixel, vec4 samples) {
  vec3 color = vec3(0.0);
  vec2 coat = vec2(0.0);
  for (int i = 0; i < int(u_samples); ++i) {
    vec4 texel = texelFetch(u_texels, pixel, i);
    color += samples[i] * texel.rgb;
    coat += samples[i] * CoatOfCode(texel.a);
  }
  // Not even a neighbor shows a surface that is far thinner than a pixel.
  bool is_missed = samples == vec4(0.0);
  color = is_missed ? vec3(1.0) : color;
  coat = is_missed ? vec2(1.0) : coat;
  float share = 1.0 / max(dot(samples, vec4(1.0)), 1.0);
  record.base_color *= color * share;
  record.roughness *= coat.x * share;
  record.metallic *= coat.y * share;
  return record;
}
#endif

#ifdef BLENDED
// Share of the pixel of each piece. Blended surfaces lie over the others with their alpha. A pane
// covers two samples of a pixel that it fills; another one before it may hide one of the two. Pieces
// of one pane lie side by side. So do all blended pieces that show no more samples than one pane.
vec4 SharesOf(uvec4 seen, uint weights) {
  vec4 sizes = vec4(0.0), alphas = vec4(0.0), surfaces = vec4(0.0);
  for (int k = 0; k < 4; ++k) {
    vec4 samples = SamplesOf(seen[k]);
    sizes[k] = dot(samples, vec4(1.0));
    surfaces[k] = ValueOfComponent(int(ComponentOf(TriangleOf(IdOf(seen[k])))));
    for (int i = 0; i < int(u_samples); ++i) {
      alphas[k] += samples[i] * AlphaOfCode(texelFetch(u_texels, ivec2(gl_FragCoord.xy), i).a);
    }
  }
  alphas /= max(sizes, vec4(1.0));
  vec4 blends = vec4(lessThan(alphas, vec4(0.999))) * vec4(greaterThan(sizes, vec4(0.0)));
  float blended = dot(sizes, blends);
  bool overlap = blended > 2.5;
  vec4 panes = vec4(0.0), hides = vec4(0.0);  // Samples of a piece's pane, and what the pane hides.
  for (int k = 0; k < 4; ++k) {
    vec4 own = blends * sizes * vec4(equal(surfaces, vec4(surfaces[k])));
    panes[k] = dot(own, vec4(1.0));
    hides[k] = dot(own, alphas) / max(panes[k], 1.0) * min(panes[k], 1.0);
  }
  vec4 shares = blends * alphas * sizes * (overlap ? 1.0 / max(panes, vec4(1.0)) : vec4(0.5));
  float left = overlap ? 1.0 : 1.0 - dot(shares, vec4(1.0));
  for (int other = 0; other < 4; ++other) {
    bool counted = !overlap || blends[other] == 0.0;
    for (int k = 0; k < other; ++k) {
      counted = counted || (blends[k] > 0.0 && surfaces[k] == surfaces[other]);
    }
    left *= counted ? 1.0 : 1.0 - hides[other];
    for (int k = 0; k < 4; ++k) {
      bool before = panes[other] > panes[k] ||
                    (panes[other] == panes[k] && surfaces[other] < surfaces[k]);
      shares[k] *= !counted && before ? 1.0 - hides[other] : 1.0;
    }
  }
  // Without any, weights need not be those of samples.
  vec4 opaque = vec4(uvec4(weights) >> uvec4(0u, 8u, 16u, 24u) & 255u) / kWeightOfPixel;
  return blended == 0.0 ? opaque
                        : shares + (1.0 - blends) * sizes * left / max(u_samples - blended, 1.0);
}
#endif

#ifdef DETAILED
// Mean of a texture over a pixel's samples that show the piece.
vec3 MeanOf(sampler2DMS texels, ivec2 pixel, vec4 samples) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < int(u_samples); ++i) {
    sum += samples[i] * texelFetch(texels, pixel, i).rgb;
  }
  return sum / max(dot(samples, vec4(1.0)), 1.0);
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

// Specular reflection of the sun and the environment by a metal or coat. `sun` includes the
// surface's cosine.
vec3 MirroredRadiance(VisibleSurface surface, vec3 f0, float roughness, vec3 sun) {
  vec3 normal = surface.normal;
  vec3 to_eye = normalize(u_eye_m - surface.position_m);
  float n_dot_v = max(dot(normal, to_eye), 1e-4);
  vec3 radiance = vec3(0.0);
#ifndef NO_SUN
  vec3 half_vector = normalize(to_eye + u_to_sun);
  float alpha = max(roughness * roughness, 1e-3);
  vec3 specular = FresnelSchlick(max(dot(to_eye, half_vector), 0.0), f0) *
                  (DistributionGgx(max(dot(normal, half_vector), 0.0), alpha) *
                   VisibilitySmith(n_dot_v, max(dot(normal, u_to_sun), 1e-4), alpha));
  radiance += specular * sun;
#endif
  // Phantoms and objects occlude the reflected sky as much as the whole incident light.
  vec3 open = max(PrefilteredEnvironment(normal, 1.0) * kPi, vec3(1e-6));
  radiance += EnvironmentBrdf(f0, roughness, n_dot_v) *
              PrefilteredEnvironment(reflect(-to_eye, normal), roughness) *
              clamp(surface.ambient_with / open, 0.0, 2.0);
  return max(max(f0.r, f0.g), f0.b) > 0.0 ? radiance : vec3(0.0);
}
#endif

#ifdef DETAILED
// Turns the normal by the bumps. The sky's light on the surface changes as that of the whole sky
// does: where a body occludes it, bumps keep their contrast.
VisibleSurface Bumped(VisibleSurface surface, vec3 gradient) {
  vec3 normal = BumpedNormal(surface.normal, gradient);
  vec3 before = PrefilteredEnvironment(surface.normal, 1.0);
  vec3 after = PrefilteredEnvironment(normal, 1.0);
  surface.ambient_with *= clamp(after / max(before, vec3(1e-6)), 0.0, 4.0);
  surface.normal = normal;
  return surface;
}
#endif

#ifdef DETAILED
// Adds the layers over the base, whose radiance is given. `coat`: the surface without bumps, which
// the clear coat fills (KHR_materials_clearcoat). `sun_lux`: across its rays.
vec3 WithLayers(vec3 base, VisibleSurface surface, VisibleSurface coat, DetailRecord detail,
                vec3 sun_lux) {
  vec3 to_eye = normalize(u_eye_m - surface.position_m);
  float n_dot_v = max(dot(surface.normal, to_eye), 1e-4);
  // KHR_materials_sheen: what the sheen reflects does not reach the base.
  float sheen = SheenReflectance(detail.sheen_roughness, n_dot_v);
  vec3 color = detail.sheen_color;
  vec3 radiance = base * (1.0 - max(max(color.r, color.g), color.b) * sheen);
  radiance += color * sheen * surface.ambient_with / kPi;
#ifndef NO_SUN
  float n_dot_l = max(dot(surface.normal, u_to_sun), 1e-4);
  float rough = max(detail.sheen_roughness, kMinSheenRoughness);
  float n_dot_h = max(dot(surface.normal, normalize(to_eye + u_to_sun)), 0.0);
  radiance += color * sun_lux * (n_dot_l * DistributionCharlie(n_dot_h, rough * rough) *
                                 VisibilityAshikhmin(n_dot_v, n_dot_l));
#endif
  float coat_n_dot_v = max(dot(coat.normal, to_eye), 1e-4);
  radiance *= 1.0 - detail.clearcoat * FresnelSchlick(coat_n_dot_v, vec3(kClearcoatF0)).x;
  return radiance + detail.clearcoat * MirroredRadiance(coat, vec3(kClearcoatF0),
                                                        detail.clearcoat_roughness,
                                                        sun_lux * max(dot(coat.normal, u_to_sun), 0.0));
}
#endif

#ifdef TRANSLUCENT
// Light from this side and from behind, and the gloss of a leaf, whose map scales it. `sun` and
// `sun_behind` include the surface's cosine, `lit_cosine`.
vec3 LeafRadiance(VisibleSurface surface, vec3 diffuse, float gloss_map, TranslucentRecord leaf,
                  vec3 sun, vec3 sun_behind, vec3 ambient_behind, float lit_cosine) {
  vec3 to_eye = normalize(u_eye_m - surface.position_m);
  float n_dot_v = max(dot(surface.normal, to_eye), 1e-4);
  float gamma = leaf.gloss_roughness, gloss = leaf.gloss * gloss_map;
  float admitted = leaf.admits * gloss;
  float leaves = LeafAdmits(n_dot_v, gamma, admitted);
  float enters = LeafAdmits(lit_cosine, gamma, admitted) / LeafAdmitsMean(gamma, admitted);
  vec3 radiance = diffuse * (leaf.base_sun * sun * enters + surface.ambient_with);
  radiance += leaf.through * (leaf.through_sun * sun_behind * enters + ambient_behind);
  radiance *= leaves / kPi;
  if (gloss > 0.0) {
    vec3 half_vector = normalize(to_eye + u_to_sun);
    radiance += gloss * sun *
                LeafLobe(max(lit_cosine, 1e-4), n_dot_v, max(dot(surface.normal, half_vector), 0.0),
                         max(dot(to_eye, half_vector), 0.0), gamma);
    vec3 open = max(PrefilteredEnvironment(surface.normal, 1.0) * kPi, vec3(1e-6));
    radiance += gloss * LeafReflectance(n_dot_v, gamma) *
                PrefilteredEnvironment(reflect(-to_eye, surface.normal), sqrt(gamma)) *
                clamp(surface.ambient_with / open, 0.0, 2.0);
  }
  return radiance;
}
#endif

vec3 ColorOf(VisibleSurface surface, MaterialRecord record
#ifdef DETAILED
             , VisibleSurface coat, DetailRecord detail
#endif
#ifdef TRANSLUCENT
             , TranslucentRecord leaf, vec3 ambient_behind
#endif
) {
#ifdef NO_SUN
  vec3 sun_lux = vec3(0.0), sun = vec3(0.0);
#else
#ifdef TRANSLUCENT
  // Light that shines through falls on the other side.
  float side = Transmits(leaf) && dot(coat.normal, u_to_sun) < 0.0 ? -1.0 : 1.0;
  float n_dot_l = max(side * dot(surface.normal, u_to_sun), 0.0);
#else
  float n_dot_l = max(dot(surface.normal, u_to_sun), 0.0);
#endif
#ifdef DETAILED
  // Where the surface without bumps faces away from the sun, its bumps receive none. Their light
  // ends gradually before, so that no edges of triangles show.
#ifdef TRANSLUCENT
  if (dot(surface.normal, coat.normal) < 0.9999) {
    n_dot_l *= smoothstep(0.0, 0.2, side * dot(coat.normal, u_to_sun));
  }
  vec3 normal = side * coat.normal;
#else
  n_dot_l *= smoothstep(0.0, 0.2, dot(coat.normal, u_to_sun));
  vec3 normal = coat.normal;  // The curved surface has no bumps.
#endif
#else
  vec3 normal = surface.normal;
#endif
  // A coarse mesh with smooth normals represents a curved surface. The sun shines on that, also
  // where its triangles already face away.
  vec3 lift = surface.lift + surface.ambient_without;
#ifdef TRANSLUCENT
  surface.flat_normal *= side;
#endif
  bool curved =
      dot(lift, normal) > 0.0 && dot(normal, u_to_sun) > dot(surface.flat_normal, u_to_sun);
#ifdef TRANSLUCENT
  if (!curved) lift *= max(side, 0.0);  // It points out of this side.
#endif
  float visibility = ShadowVisibility(1, surface.position_m + lift,
                                      curved ? normal : surface.flat_normal, surface.step_x,
                                      surface.step_y);
  visibility *= SunTransmittance(surface.position_m) * CloudTransmittance(surface.position_m);
  vec3 sun_lux = u_sun_normal_lux * visibility;
  vec3 sun = sun_lux * n_dot_l;
#endif

  vec3 diffuse = record.base_color * (1.0 - record.metallic) * record.base_under_coat;
#ifdef TRANSLUCENT
#ifdef NO_SUN
  vec3 sun_behind = vec3(0.0);
  float lit_cosine = 0.0;
#else
  vec3 sun_behind = side < 0.0 ? sun : vec3(0.0);
  sun -= sun_behind;
  if (side < 0.0) sun_lux = vec3(0.0);  // None for the layers of this side.
  float lit_cosine = n_dot_l;
#endif
  vec3 radiance = LeafRadiance(surface, diffuse, record.roughness, leaf, sun, sun_behind,
                               ambient_behind, lit_cosine);
#else
  vec3 radiance = diffuse * (sun + surface.ambient_with) / kPi;
#endif

#ifdef GLOSSY
  vec3 f0 = vec3(record.dielectric_f0);
#ifdef DETAILED
  f0 = min(f0 * detail.coat_tint, vec3(1.0));
#endif
  radiance += MirroredRadiance(surface, mix(f0, record.base_color, record.metallic),
                               record.roughness, sun);
#endif
#ifdef DETAILED
  radiance = WithLayers(radiance, surface, coat, detail, sun_lux) + detail.emitted_cd_m2;
#endif
  FogAir air = FogUpTo(distance(u_eye_m, surface.position_m), u_fog_split_m, u_fog_optical_depth,
                       u_fog_inscattered);
  return u_exposure_scale * (radiance * air.left + air.light);
}

void main() {
  uvec4 seen = texelFetch(u_visible, ivec2(gl_FragCoord.xy), 0);
  uvec2 weights = texelFetch(u_weights, ivec2(gl_FragCoord.xy), 0).rg;
  vec4 sum = vec4(0.0);
#ifdef BLENDED
  float covered = 0.0;
  vec4 shares = SharesOf(seen, weights.x);
#endif
  do {
    uvec4 triangle = TriangleOf(IdOf(seen.x));
    MaterialRecord record = RecordOf(int(ValueOfComponent(int(ComponentOf(triangle)))));
    VisibleSurface surface =
        VisibleSurfaceOf(Moved(VertexOf(triangle.x), record), Moved(VertexOf(triangle.y), record),
                    Moved(VertexOf(triangle.z), record), gl_FragCoord.xy);
#ifdef TEXTURED
    ivec2 donor = DonorPixel(weights.y & 255u);
    vec4 samples = SamplesOf(seen.x);
    record = Textured(record, donor, samples);
#endif
#ifdef DETAILED
    DetailRecord detail = DetailOf(int(ValueOfComponent(int(ComponentOf(triangle)))));
#ifdef TRANSLUCENT
    TranslucentRecord leaf = TranslucentOf(int(ValueOfComponent(int(ComponentOf(triangle)))));
    vec3 ambient_behind = vec3(0.0);
    if (Transmits(leaf)) {  // The vertices have the light behind them in place of their lift.
      // A lift turns with its object, light does not.
      ambient_behind =
          inverse(transpose(mat3(record.row_x.xyz, record.row_y.xyz, record.row_z.xyz))) *
          surface.ambient_without;
      surface.ambient_without = vec3(0.0);
      leaf.through *= MeanOf(u_emissions, donor, samples);
    } else {
      detail.emitted_cd_m2 *= MeanOf(u_emissions, donor, samples);
    }
#else
    detail.emitted_cd_m2 *= MeanOf(u_emissions, donor, samples);
#endif
    VisibleSurface bumped = Bumped(surface, MeanOf(u_gradients, donor, samples));
#ifdef TRANSLUCENT
    vec3 shaded = ColorOf(bumped, record, surface, detail, leaf, ambient_behind);
#else
    vec3 shaded = ColorOf(bumped, record, surface, detail);
#endif
    vec3 color = mix(shaded, record.base_color, detail.unlit);
#else
    vec3 color = ColorOf(surface, record);
#endif
#ifdef BLENDED
    sum += shares.x * vec4(color, 1.0);
    covered += WeightOf(weights.x);
    shares = vec4(shares.yzw, 0.0);
#else
    sum += WeightOf(weights.x) / kWeightOfPixel * vec4(color, 1.0);
#endif
    seen = uvec4(seen.yzw, 0u);
    weights >>= 8;
  } while (seen.x != 0u);
  out_color = sum;
#ifdef BLENDED
  out_sample_weight = (1.0 - sum.a) / max(kWeightOfPixel - covered, 1.0);
#endif
}
