#version 450 core
// A virtual object's display-linear colour; coverage comes from multisampling. Drawn with NO_SUN where
// all of it is turned away from the sun.

#include "compositor/shaders/aerial_fog.glsl"
#include "compositor/shaders/ggx.glsl"
#include "compositor/shaders/seen_sunlight.glsl"
#ifndef SHADOW_SETS
#define SHADOW_SETS 2  // 0: phantoms alone, 1: with the virtual objects.
#endif
#include "shadows/shaders/shadow_visibility.glsl"

in vec3 v_position_m;
in vec3 v_normal;
in vec2 v_uv;
centroid in vec3 v_ambient_with;

uniform vec3 u_to_sun;           // Unit, marker coordinates.
uniform vec3 u_sun_normal_lux;   // Linear Rec.709.
uniform vec3 u_eye_m;            // Centre of projection, marker coordinates.
uniform vec3 u_gain;             // Display-linear value per radiance.
uniform vec3 u_base_color;       // Linear reflectance.
uniform float u_metallic;
uniform float u_roughness;
uniform float u_dielectric_f0;   // Normal reflectance of the coat; 0: purely diffuse.

uniform float u_fog_split_m[kFogSplits];  // FogSplits of compositor/aerial_fog.h.
uniform vec3 u_fog_optical_depth[kFogSplits];
uniform vec3 u_fog_inscattered[kFogSplits];

layout(binding = 0) uniform sampler2D u_base_color_texture;
layout(binding = 1) uniform sampler2DArray u_environment;  // EnvironmentMap, a layer a roughness.

layout(location = 0) out vec4 out_color;

vec3 PrefilteredEnvironment(vec3 direction, float roughness) {
  vec2 uv = vec2(atan(direction.y, direction.x) / (2.0 * kPi) + 0.5,
                 acos(clamp(direction.z, -1.0, 1.0)) / kPi);
  float level = roughness * float(textureSize(u_environment, 0).z - 1);
  vec3 low = texture(u_environment, vec3(uv, floor(level))).rgb;
  vec3 high = texture(u_environment, vec3(uv, ceil(level))).rgb;
  return mix(low, high, fract(level));
}

void main() {
  vec3 normal = normalize(v_normal);
  vec3 to_eye = normalize(u_eye_m - v_position_m);
  vec4 texel = texture(u_base_color_texture, v_uv);
  if (texel.a < 0.5) discard;  // Cut-out leaves and fences; blending needs an order.
  vec3 base_color = u_base_color * texel.rgb;

#ifdef NO_SUN
  vec3 sun = vec3(0.0);
#else
  vec3 flat_normal = ShadowGeometricNormal(v_position_m, normal);
  vec3 step_x = dFdx(v_position_m);
  vec3 step_y = dFdy(v_position_m);
  float n_dot_l = max(dot(normal, u_to_sun), 0.0);
  float visibility = n_dot_l > 0.0 ? ShadowVisibility(1, v_position_m, flat_normal, step_x, step_y) : 0.0;
  visibility *= SeenSunlight(v_position_m);
  vec3 sun = u_sun_normal_lux * (visibility * n_dot_l);
#endif

  vec3 diffuse = base_color * (1.0 - u_metallic) * (1.0 - u_dielectric_f0);
  vec3 radiance = diffuse * (sun + v_ambient_with) / kPi;

  vec3 f0 = mix(vec3(u_dielectric_f0), base_color, u_metallic);
  if (max(max(f0.r, f0.g), f0.b) > 0.0) {
    float n_dot_v = max(dot(normal, to_eye), 1e-4);
#ifndef NO_SUN
    vec3 half_vector = normalize(to_eye + u_to_sun);
    float alpha = max(u_roughness * u_roughness, 1e-3);
    vec3 specular = FresnelSchlick(max(dot(to_eye, half_vector), 0.0), f0) *
                    (DistributionGgx(max(dot(normal, half_vector), 0.0), alpha) *
                     VisibilitySmith(n_dot_v, max(n_dot_l, 1e-4), alpha));
    radiance += specular * sun;
#endif
    radiance += EnvironmentBrdf(f0, u_roughness, n_dot_v) *
                PrefilteredEnvironment(reflect(-to_eye, normal), u_roughness);
  }
  FogAir air = FogUpTo(distance(u_eye_m, v_position_m), u_fog_split_m, u_fog_optical_depth,
                       u_fog_inscattered);
  radiance = radiance * air.left + air.light;
  out_color = vec4(u_gain * radiance, 1.0);
}
