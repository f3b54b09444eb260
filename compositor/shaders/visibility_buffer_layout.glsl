#ifndef COMPOSITOR_TRIANGLE_LAYOUT_GLSL
#define COMPOSITOR_TRIANGLE_LAYOUT_GLSL
// How the table of compositor/surfaces/visibility_buffer.h is laid out, and how pictures name its triangles.
// Numbers alone; compiled as C++ too (gl/glsl_as_cpp.h, tests/compositor/shaders/shader_twins_test.cc).

const int kTrianglesPerRow = 4096, kVerticesPerRow = 1365, kTexelsPerVertex = 3;
const int kTexelsPerSurface = 5, kSurfacesPerRow = 819;
const int kTexelsPerLinearRatio = 5, kLinearRatiosPerRow = 819;
const int kKindBits = 3;

// Texel of a triangle, and of a component, from 0 on.
ivec2 TexelOfTriangle(int index) { return ivec2(index % kTrianglesPerRow, index / kTrianglesPerRow); }
// First texel of a vertex.
ivec2 TexelOfVertex(int vertex) {
  return ivec2(kTexelsPerVertex * (vertex % kVerticesPerRow), vertex / kVerticesPerRow);
}
// First texel of a surface of an object (compositor/surfaces/material_table.h).
ivec2 TexelOfSurface(int surface) {
  return ivec2(kTexelsPerSurface * (surface % kSurfacesPerRow), surface / kSurfacesPerRow);
}

// First texel of a triangle's steady ratio (compositor/surfaces/linear_shadow_ratio.h).
ivec2 TexelOfLinearRatio(int index) {
  return ivec2(kTexelsPerLinearRatio * (index % kLinearRatiosPerRow), index / kLinearRatiosPerRow);
}

// Of the real surfaces' triangles: AffectedTriangles::Change, the last of which is named below. Of the
// objects': 0 where the sun may shine, else 1.
uint KindOf(uvec4 triangle) { return triangle.w & ((1u << kKindBits) - 1u); }
const uint kNothing = 3u;
uint ComponentOf(uvec4 triangle) { return triangle.w >> kKindBits; }

// In the picture of the samples' numbers: of an object, whose triangles have numbers of their own.
const uint kObjectBit = 1u << 31;

// What a pixel shows: a triangle's number and which of its samples, a bit each, which add up.
const int kSamplesShift = 28;
uint VisibleTriangle(uint id, uvec4 samples) {
  return (samples.x + 2u * samples.y + 4u * samples.z + 8u * samples.w) << kSamplesShift | id;
}
uint IdOf(uint seen) { return seen & ((1u << kSamplesShift) - 1u); }
// 1 for each sample, else 0.
vec4 SamplesOf(uint seen) {
  return vec4((uvec4(seen >> kSamplesShift) >> uvec4(0u, 1u, 2u, 3u)) & uvec4(1u));
}

// Depth of the pixels of which no more changes than AffectedTriangles::Change `kind`. Mirrors
// ShadowRatioPass::DepthOf.
float DepthOfKind(uint kind) { return 0.125f * float(kind + 1u); }

#endif
