#version 450 core
// Which triangle a sample of the picture shows: its number in a table of
// compositor/triangle_table.h, from 1 on. 0: nothing that changes.
//
// OBJECT: of a virtual object. TEXTURED: with what its texture leaves of the base colour, too.

#include "compositor/shaders/triangle_layout.glsl"

uniform int u_first_id;
uniform int u_step;  // 1; 0 where a whole draw is one number.

layout(location = 0) out uint out_id;

#ifdef TEXTURED
in vec2 v_uv;
layout(binding = 0) uniform sampler2D u_base_color_texture;
layout(location = 1) out vec4 out_texel;
#endif

void main() {
  out_id = uint(u_first_id + u_step * gl_PrimitiveID);
#ifdef OBJECT
  out_id |= kObjectBit;
#endif
#ifdef TEXTURED
  out_texel = texture(u_base_color_texture, v_uv);
  if (out_texel.a < 0.5) discard;  // Cut-out leaves and fences; blending needs an order.
#endif
}
