#ifndef COMPOSITOR_TRIANGLE_LAYOUT_GLSL
#define COMPOSITOR_TRIANGLE_LAYOUT_GLSL
// Layout of the table of compositor/surfaces/visibility_buffer.h, and encoding of its triangle
// numbers. Arithmetic only; also compiled as C++ (gl/glsl_as_cpp.h,
// tests/compositor/shaders/shader_twins_test.cc).

const int kTrianglesPerRow = 4096, kVerticesPerRow = 1365, kTexelsPerVertex = 3;
const int kTexelsPerSurface = 11, kSurfacesPerRow = 512;
const int kTexelsPerLinearRatio = 5, kLinearRatiosPerRow = 819;
const int kKindBits = 3;

// Texel of a triangle, or of a component, from 0 on.
ivec2 TexelOfTriangle(int index) { return ivec2(index % kTrianglesPerRow, index / kTrianglesPerRow); }
// First texel of a vertex.
ivec2 TexelOfVertex(int vertex) {
  return ivec2(kTexelsPerVertex * (vertex % kVerticesPerRow), vertex / kVerticesPerRow);
}
// First texel of a surface of an object (compositor/surfaces/material_table.h).
ivec2 TexelOfSurface(int surface) {
  return ivec2(kTexelsPerSurface * (surface % kSurfacesPerRow), surface / kSurfacesPerRow);
}

// First texel of a triangle's linear ratio (compositor/surfaces/linear_shadow_ratio.h).
ivec2 TexelOfLinearRatio(int index) {
  return ivec2(kTexelsPerLinearRatio * (index % kLinearRatiosPerRow), index / kLinearRatiosPerRow);
}

// Real surfaces: AffectedTriangles::Change, or kNothing. Objects: 0 where the sun may shine, else
// 1.
uint KindOf(uvec4 triangle) { return triangle.w & ((1u << kKindBits) - 1u); }
const uint kNothing = 3u;
uint ComponentOf(uvec4 triangle) { return triangle.w >> kKindBits; }

// Marks numbers of objects' triangles in the visibility buffer; they are counted separately.
const uint kObjectBit = 1u << 31;

// Packs a triangle's number with its samples, one bit each, so that the samples can be added.
const int kSamplesShift = 28;
uint VisibleTriangle(uint id, uvec4 samples) {
  return (samples.x + 2u * samples.y + 4u * samples.z + 8u * samples.w) << kSamplesShift | id;
}
uint IdOf(uint seen) { return seen & ((1u << kSamplesShift) - 1u); }
// 1 for each sample, else 0.
vec4 SamplesOf(uint seen) {
  return vec4((uvec4(seen >> kSamplesShift) >> uvec4(0u, 1u, 2u, 3u)) & uvec4(1u));
}

// Classification depth of pixels with at most the change AffectedTriangles::Change `kind`. Must
// match ShadowRatioPass::DepthOf.
float DepthOfKind(uint kind) { return 0.125f * float(kind + 1u); }

#endif
