#version 450 core
// Shows one shadow map in its partition's tint: dark nearest to the sun, nearly black where it is
// empty.
#include "compositor/shaders/shadow_tints.glsl"
layout(binding = 0) uniform sampler2DArray u_maps;
uniform int u_slice;
uniform int u_texels;  // Per side of the map.
uniform vec2 u_origin_px;  // Origin of the tile in the image.
uniform float u_texels_px;  // Texels per pixel.
layout(location = 0) out vec4 out_color;

void main() {
  ivec2 texel = ivec2((gl_FragCoord.xy - u_origin_px) * u_texels_px);
  texel.y = u_texels - 1 - texel.y;  // The map's row 0 is its lowest.
  float depth = texelFetch(u_maps, ivec3(clamp(texel, 0, u_texels - 1), u_slice), 0).r;
  out_color =
      vec4(depth < 1.0 ? kPartitionTints[u_slice] * (0.1 + 0.9 * depth) : vec3(0.1), 1.0);
}
