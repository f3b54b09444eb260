#ifndef COMPOSITOR_WINDING_GLSL
#define COMPOSITOR_WINDING_GLSL
// Winding numbers of areas, seen from above. Arithmetic only; also compiled as C++
// (gl/glsl_as_cpp.h, compositor/ink/ink_grid.cc).

// Side of a point: positive to the left of the edge.
float SideOfEdge(vec2 from, vec2 to, vec2 place) {
  vec2 along = to - from, at = place - from;
  return along.x * at.y - along.y * at.x;
}

// 1 or −1 where the way from `center` to `place` crosses an edge from its right to its left or the
// other way, else 0. Each end of an edge, and of the way, counts to one side.
float CrossingOfEdge(vec2 center, vec2 place, vec2 from, vec2 to) {
  bool center_left = SideOfEdge(from, to, center) >= 0.0f;
  bool place_left = SideOfEdge(from, to, place) >= 0.0f;
  bool from_left = SideOfEdge(center, place, from) >= 0.0f;
  bool to_left = SideOfEdge(center, place, to) >= 0.0f;
  bool crosses = center_left != place_left && from_left != to_left;
  return crosses ? (place_left ? 1.0f : -1.0f) : 0.0f;
}

#endif
