#ifndef COMPOSITOR_PIXEL_PIECES_GLSL
#define COMPOSITOR_PIXEL_PIECES_GLSL
// The real surfaces that a pixel shows, from the triangle numbers of its samples.

#include "compositor/shaders/visibility_buffer.glsl"

layout(binding = 0) uniform usampler2DMS u_ids;
uniform int u_samples;  // Per pixel, 4 at most.

struct PixelPieces {
  uvec4 seen;  // First to last: VisibleTriangle, one triangle per component; 0: no more.
  uint kind;   // The least KindOf() of the samples.
};

PixelPieces PiecesOfPixel(ivec2 pixel) {
  // Remaining numbers; 0: nothing, an object, or done.
  uvec4 left = uvec4(0u);
  for (int i = 0; i < u_samples; ++i) left[i] = texelFetch(u_ids, pixel, i).r;
  left *= uvec4(lessThan(left, uvec4(kObjectBit)));
  uvec4 seen = uvec4(0u), components = uvec4(~0u);
  uint kind = kNothing;
  int found = 0;
  // Most pixels show one triangle and need one iteration. Tested at its end, see
  // shadow_visibility.glsl.
  do {
    uint id = left.x != 0u ? left.x : left.y != 0u ? left.y : left.z != 0u ? left.z : left.w;
    uvec4 same_id = uvec4(equal(left, uvec4(id)));
    left *= 1u - same_id;
    uvec4 triangle = TriangleOf(id);
    bvec4 same_component = equal(components, uvec4(ComponentOf(triangle)));
    bool known = any(same_component);
    uvec4 slot = uvec4(known ? same_component : equal(ivec4(found), ivec4(0, 1, 2, 3)));
    slot *= uint(id != 0u);
    seen += slot * VisibleTriangle(known ? 0u : id, same_id);
    components = mix(components, uvec4(ComponentOf(triangle)), equal(slot, uvec4(1u)));
    found += known ? 0 : 1;
    kind = id == 0u ? kind : min(kind, KindOf(triangle));
  } while (any(notEqual(left, uvec4(0u))));
  PixelPieces pieces;
  pieces.seen = seen;
  pieces.kind = kind;
  return pieces;
}

#endif
