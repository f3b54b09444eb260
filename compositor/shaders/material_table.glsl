#ifndef COMPOSITOR_MATERIAL_TABLE_GLSL
#define COMPOSITOR_MATERIAL_TABLE_GLSL
// Materials and transforms of the virtual objects' surfaces, in the layout of
// compositor/surfaces/material_table.h.

#include "compositor/shaders/visibility_buffer_layout.glsl"

layout(binding = 2) uniform sampler2D u_surfaces;

struct MaterialRecord {
  vec3 base_color;  // Linear reflectance, before the texture.
  float metallic, roughness;
  float dielectric_f0;       // Normal reflectance of the coat; 0: purely diffuse.
  float base_under_coat;  // Share of the base color's light that the coat transmits.
  // Current marker coordinates from those of the baked lighting. Angles stay.
  vec4 row_x, row_y, row_z;
};

MaterialRecord RecordOf(int surface) {
  ivec2 at = TexelOfSurface(surface);
  vec4 color = texelFetch(u_surfaces, at, 0);
  vec4 coat = texelFetch(u_surfaces, at + ivec2(1, 0), 0);
  return MaterialRecord(color.rgb, color.a, coat.x, coat.y, coat.z,
                       texelFetch(u_surfaces, at + ivec2(2, 0), 0),
                       texelFetch(u_surfaces, at + ivec2(3, 0), 0),
                       texelFetch(u_surfaces, at + ivec2(4, 0), 0));
}

#ifdef TRANSLUCENT
// A surface that transmits light, or a leaf. Opaque ones have no color here.
struct TranslucentRecord {
  vec3 through;  // Transmittance of the sky's light, before the texture.
  float admits;  // 1: light enters and leaves past the gloss; 0: its diffuse part has all of it.
  vec3 through_sun, base_sun;  // Factors of sunlight: of transmittance and base color.
  float gloss, gloss_roughness;
};

TranslucentRecord TranslucentOf(int surface) {
  ivec2 at = TexelOfSurface(surface);
  vec4 through = texelFetch(u_surfaces, at + ivec2(8, 0), 0);
  vec4 through_sun = texelFetch(u_surfaces, at + ivec2(9, 0), 0);
  vec4 base_sun = texelFetch(u_surfaces, at + ivec2(10, 0), 0);
  return TranslucentRecord(through.rgb, through.a, through_sun.rgb, base_sun.rgb, through_sun.a,
                           base_sun.a);
}

bool Transmits(TranslucentRecord leaf) { return leaf.through != vec3(0.0); }
#endif

#ifdef DETAILED
struct DetailRecord {
  vec3 emitted_cd_m2;
  float unlit;  // 1 for unlit surfaces.
  vec3 coat_tint;
  float clearcoat, clearcoat_roughness;
  vec3 sheen_color;
  float sheen_roughness;
};

DetailRecord DetailOf(int surface) {
  ivec2 at = TexelOfSurface(surface);
  vec4 emission = texelFetch(u_surfaces, at + ivec2(5, 0), 0);
  vec4 coat = texelFetch(u_surfaces, at + ivec2(6, 0), 0);
  vec4 sheen = texelFetch(u_surfaces, at + ivec2(7, 0), 0);
  float clearcoat_roughness = texelFetch(u_surfaces, at + ivec2(1, 0), 0).w;
  return DetailRecord(emission.rgb, emission.a, coat.rgb, coat.a, clearcoat_roughness, sheen.rgb,
                      sheen.a);
}
#endif

BufferVertex Moved(BufferVertex vertex, MaterialRecord record) {
  vec4 place = vec4(vertex.position_m, 1.0);
  vec3 normal = vertex.normal, lift = vertex.ambient_without;
  vertex.position_m =
      vec3(dot(record.row_x, place), dot(record.row_y, place), dot(record.row_z, place));
  vertex.normal = vec3(dot(record.row_x.xyz, normal), dot(record.row_y.xyz, normal),
                       dot(record.row_z.xyz, normal));
  vertex.ambient_without =
      vec3(dot(record.row_x.xyz, lift), dot(record.row_y.xyz, lift), dot(record.row_z.xyz, lift));
  return vertex;
}

#endif
