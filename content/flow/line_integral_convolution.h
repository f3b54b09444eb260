#pragma once

#include "base/error.h"
#include "base/image.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// A texture of a flow in the plane of x and y.
struct ConvolutionOptions {
  int width = 512, height = 512;  ///< Pixels over the bounds; row 0 has the largest y.
  double step_pixels = 1.0;
  int levels = 6;        ///< 2^levels steps each way.
  double grain_m = 0.0;  ///< Size of the noise, fixed to the place; 0: two pixels.
  int threads = 0;       ///< 0: one for each processor.
};

/// Line integral convolution (Cabral, Leedom 1993): each pixel is the mean of noise along its
/// streamline, 2^levels steps each way. Steps have one length. By levels (Hlawatsch, Sadlo,
/// Weiskopf 2011): s(y) ← s(y) + s(y + D(y)) doubles the steps of a sum. Values 0…255, around
/// 127.5, without a stretch of contrast; 0 in walls. Errors (input): those of reading; sizes out of
/// range.
Result<Image<float>> ConvolveByLevels(const VectorField& field, Seconds frozen_s,
                                      const ConvolutionOptions& options);

/// The same along each streamline: the reference.
Result<Image<float>> ConvolveSerially(const VectorField& field, Seconds frozen_s,
                                      const ConvolutionOptions& options);

}  // namespace pleinair::content
