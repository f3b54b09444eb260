#ifndef COMPOSITOR_SUN_SEEN_GLSL
#define COMPOSITOR_SUN_SEEN_GLSL
// The share of the sun that the camera image shows on a real surface.

#include "compositor/shaders/aerial_perspective.glsl"
#include "compositor/shaders/sun_transmittance_map.glsl"
#include "compositor/shaders/visible_surface.glsl"

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
