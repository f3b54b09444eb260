#ifndef COMPOSITOR_TRIANGLE_LAYOUT_GLSL
#define COMPOSITOR_TRIANGLE_LAYOUT_GLSL
// How the table of compositor/triangle_table.h is laid out, and how pictures name its triangles.
// Numbers alone; compiled as C++ too (gl/glsl_as_cpp.h, tests/compositor/shader_twins_test.cc).

const int kTrianglesARow = 4096, kVerticesARow = 1365, kTexelsAVertex = 3;
const int kKindBits = 2;

// Texel of a triangle, and of a sheet, from 0 on.
ivec2 TexelOfTriangle(int index) { return ivec2(index % kTrianglesARow, index / kTrianglesARow); }
// First texel of a vertex.
ivec2 TexelOfVertex(int vertex) {
  return ivec2(kTexelsAVertex * (vertex % kVerticesARow), vertex / kVerticesARow);
}

uint KindOf(uvec4 triangle) { return triangle.w & ((1u << kKindBits) - 1u); }  // Change.
uint SheetOf(uvec4 triangle) { return triangle.w >> kKindBits; }

// What a pixel shows: a triangle's number and of how many samples, which add up.
const int kCountShift = 28;
uint SeenTriangle(uint id, uint count) { return count << kCountShift | id; }
uint IdOf(uint seen) { return seen & ((1u << kCountShift) - 1u); }
uint CountOf(uint seen) { return seen >> kCountShift; }

// Depth of the pixels of which no more changes than ChangingTriangles::Change `kind`. Mirrors
// RatioPass::DepthOf.
float DepthOfKind(uint kind) { return 0.25f * float(kind + 1u); }

#endif
