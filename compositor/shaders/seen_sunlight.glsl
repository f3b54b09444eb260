#ifndef COMPOSITOR_SEEN_SUNLIGHT_GLSL
#define COMPOSITOR_SEEN_SUNLIGHT_GLSL
// Share of the sun that reaches a place past trees and all that no phantom stands for: the map of
// compositor/light/sun_transmittance_map.h, which lies across the sun's rays.

layout(binding = 5) uniform sampler2D u_sunlight;
uniform vec4 u_sunlight_s;  // The map's coordinates, 0 to 1, from marker coordinates (m, 1).
uniform vec4 u_sunlight_t;

float SeenSunlight(vec3 position_m) {
  vec4 place = vec4(position_m, 1.0);
  return texture(u_sunlight, vec2(dot(u_sunlight_s, place), dot(u_sunlight_t, place))).r;
}

#endif
