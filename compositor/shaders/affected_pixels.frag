#version 450 core
// Classifies a pixel of the real surfaces. Output: one triangle per visible component of a real
// surface, with the samples that show this component. The depth is the maximum
// AffectedTriangles::Change of the samples, for the passes that shade.

#include "compositor/shaders/piece_weights.glsl"
#include "compositor/shaders/pixel_pieces.glsl"

layout(location = 0) out uvec4 out_visible;  // First to last: VisibleTriangle.
layout(location = 1) out uvec2 out_weights;  // As piece_weights.glsl.

void main() {
  PixelPieces pieces = PiecesOfPixel(ivec2(gl_FragCoord.xy));
  out_visible = pieces.seen;
  out_weights = uvec2(WeightsOfSamples(pieces.seen, u_samples), 0u);
  gl_FragDepth = DepthOfKind(pieces.kind);
}
