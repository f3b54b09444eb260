#version 450 core
// Replaces what sorting found by samples, in the pixels whose coverage the processor computed
// (compositor/coverage/scene_coverage.h). OBJECT: the virtual objects, else the real surfaces.
// TEXTURED, with OBJECT: also finds the samples from which each piece takes its textures.

#include "compositor/shaders/visibility_buffer.glsl"

layout(binding = 20) uniform usampler2D u_marks;   // Bits of 32 pixels; number of their first one.
layout(binding = 21) uniform usampler2D u_pieces;  // PixelPieces, three texels each.

layout(location = 0) out uvec4 out_visible;  // First to last: VisibleTriangle.
layout(location = 1) out uvec2 out_weights;  // As piece_weights.glsl; where textures come from.

// As compositor/passes/coverage_pass.cc and PixelPieces.
const int kPixelsPerRow = 1024, kTexelsPerPixel = 3;
const uint kKeepSamples = 7u;

uvec4 PieceTexel(int pixel, int texel) {
  return texelFetch(u_pieces, ivec2(kTexelsPerPixel * (pixel % kPixelsPerRow) + texel,
                                    pixel / kPixelsPerRow), 0);
}

#ifdef TEXTURED
#include "compositor/shaders/texture_donor.glsl"

layout(binding = 0) uniform usampler2DMS u_ids;
uniform int u_samples;  // Per pixel, 4 at most.

uvec4 SamplesShowing(ivec2 pixel, float surface) {
  uvec4 found = uvec4(0u);
  for (int i = 0; i < u_samples; ++i) {
    uint id = texelFetch(u_ids, pixel, i).r;
    uint component = ComponentOf(TriangleOf(id & ~kObjectBit));
    bool shows = id > kObjectBit && ValueOfComponent(int(component)) == surface;
    found[i] = uint(shows);
  }
  return found;
}

// A piece of surface as VisibleTriangle, with the samples of the nearest pixel that shows its
// surface. `seen`: with the samples of this pixel that show the piece by the processor's count.
// `donor`: the pixel, as DonorPixel() takes it.
uint WithDonor(uint seen, out uint donor) {
  uint id = IdOf(seen);
  float surface = ValueOfComponent(int(ComponentOf(TriangleOf(id))));
  uvec4 samples = uvec4(SamplesOf(seen));
  int i = 0;
  ivec2 last = textureSize(u_ids) - 1;
  // Tested at its end, see shadow_visibility.glsl.
  do {
    ivec2 at = DonorPixel(uint(i));
    bool exists = at == clamp(at, ivec2(0), last);
    uvec4 showing = SamplesShowing(at, surface) * uint(exists);
    samples = i == 0 ? samples * showing : showing;
    donor = uint(i);
    ++i;
  } while (samples == uvec4(0u) && i < kDonors);
  return id == 0u ? 0u : VisibleTriangle(id, samples);
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uvec2 marks = texelFetch(u_marks, ivec2(pixel.x / 32, pixel.y), 0).xy;
  uint bit = uint(pixel.x % 32);
  if ((marks.x >> bit & 1u) == 0u) discard;
  int number = int(marks.y) + bitCount(marks.x & ((1u << bit) - 1u));
  uvec4 common_texel = PieceTexel(number, 2);
  if (common_texel.z == kKeepSamples) discard;
#ifdef OBJECT
  uvec4 seen = PieceTexel(number, 0);
  uvec2 weights = uvec2(common_texel.x, 0u);
  uint kind = common_texel.z;
#ifdef TEXTURED
  uint donor;
  int k = 0;
  uvec4 left = seen;
  do {
    seen[k] = WithDonor(left.x, donor);
    weights.y |= donor << (8 * k);
    left = uvec4(left.yzw, 0u);
    ++k;
  } while (left.x != 0u);
#endif
#else
  uvec4 seen = PieceTexel(number, 1);
  uvec2 weights = uvec2(common_texel.y, 0u);
  uint kind = common_texel.w;
#endif
  out_visible = seen;
  out_weights = weights;
  gl_FragDepth = DepthOfKind(kind);
}
