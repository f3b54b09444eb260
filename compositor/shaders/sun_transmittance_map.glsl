#ifndef COMPOSITOR_SUN_TRANSMITTANCE_MAP_GLSL
#define COMPOSITOR_SUN_TRANSMITTANCE_MAP_GLSL
// Sun transmittance of unmodelled objects such as trees. The map of
// compositor/light/sun_transmittance_map.h lies across the sun's rays.

layout(binding = 5) uniform sampler2D u_sun_transmittance;
uniform vec4 u_sun_transmittance_s;  // The map's coordinates, 0 to 1, from marker coordinates (m, 1).
uniform vec4 u_sun_transmittance_t;

float SunTransmittance(vec3 position_m) {
  vec4 place = vec4(position_m, 1.0);
  return texture(u_sun_transmittance, vec2(dot(u_sun_transmittance_s, place), dot(u_sun_transmittance_t, place))).r;
}

// That of layers of clouds, relative to the sun's strength in the frame.
layout(binding = 22) uniform sampler2D u_cloud_transmittance;
uniform vec4 u_cloud_transmittance_s;
uniform vec4 u_cloud_transmittance_t;

float CloudTransmittance(vec3 position_m) {
  vec4 place = vec4(position_m, 1.0);
  return texture(u_cloud_transmittance,
                 vec2(dot(u_cloud_transmittance_s, place), dot(u_cloud_transmittance_t, place))).r;
}

#endif
