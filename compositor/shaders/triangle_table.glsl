#ifndef COMPOSITOR_TRIANGLE_TABLE_GLSL
#define COMPOSITOR_TRIANGLE_TABLE_GLSL
// The real surfaces' triangles as compositor/triangle_table.h lays them out.

layout(binding = 1) uniform usampler2D u_triangles;  // Vertices; sheet and kind.
layout(binding = 6) uniform sampler2D u_vertices;    // Three texels each.

const int kTrianglesARow = 4096, kVerticesARow = 1365;

uvec4 TriangleOf(uint id) {
  int index = int(id) - 1;
  return texelFetch(u_triangles, ivec2(index % kTrianglesARow, index / kTrianglesARow), 0);
}
uint KindOf(uvec4 triangle) { return triangle.w & 3u; }  // ChangingTriangles::Change.
uint SheetOf(uvec4 triangle) { return triangle.w >> 2; }

struct TableVertex {
  vec3 position_m, normal, ambient_with, ambient_without;
};

TableVertex VertexOf(uint vertex) {
  ivec2 at = ivec2(3 * (int(vertex) % kVerticesARow), int(vertex) / kVerticesARow);
  vec4 first = texelFetch(u_vertices, at, 0);
  vec4 second = texelFetch(u_vertices, at + ivec2(1, 0), 0);
  vec4 third = texelFetch(u_vertices, at + ivec2(2, 0), 0);
  return TableVertex(first.xyz, vec3(first.w, second.w, third.w), second.xyz, third.xyz);
}

#endif
