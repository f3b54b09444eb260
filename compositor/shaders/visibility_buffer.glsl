#ifndef COMPOSITOR_VISIBILITY_BUFFER_GLSL
#define COMPOSITOR_VISIBILITY_BUFFER_GLSL
// Triangle table in the layout of compositor/surfaces/visibility_buffer.h.

#include "compositor/shaders/visibility_buffer_layout.glsl"

layout(binding = 1) uniform usampler2D u_triangles;  // Vertices; component and kind.
layout(binding = 6) uniform sampler2D u_vertices;    // Three texels each.
// Per component: green albedo of a real surface, surface number of an object.
layout(binding = 7) uniform sampler2D u_component_values;

// Numbers start at 1. For 0, no triangle, it returns the first one: the result is unused, but the
// texel must exist.
uvec4 TriangleOf(uint id) {
  return texelFetch(u_triangles, TexelOfTriangle(int(max(id, 1u)) - 1), 0);
}

float ValueOfComponent(int component) { return texelFetch(u_component_values, TexelOfTriangle(component), 0).r; }

struct BufferVertex {
  vec3 position_m, normal, ambient_with;
  vec3 ambient_without;  // Of a virtual object: its lift (MeshSunlight::lifts).
};

BufferVertex VertexOf(uint vertex) {
  ivec2 at = TexelOfVertex(int(vertex));
  vec4 first = texelFetch(u_vertices, at, 0);
  vec4 second = texelFetch(u_vertices, at + ivec2(1, 0), 0);
  vec4 third = texelFetch(u_vertices, at + ivec2(2, 0), 0);
  return BufferVertex(first.xyz, vec3(first.w, second.w, third.w), second.xyz, third.xyz);
}

#endif
