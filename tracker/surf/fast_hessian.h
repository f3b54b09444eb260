#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracker/surf/hessian_row.h"
#include "tracker/surf/integral_image.h"
#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

/// Edge of the filter of `layer` (0..3) of `octave` (0..), px: 9, 15, 21, 27; 15, 27, 39, 51;
/// 27, 51, 75, 99; ... (Bay et al. 2008, section 3.3, Fig. 5).
constexpr int FilterSize(int octave, int layer) { return 3 * ((2 << octave) * (layer + 1) + 1); }

/// The Fast-Hessian detector (Bay et al. 2008, section 3): maxima of the determinant of the Hessian
/// in position and scale, interpolated.
///
/// The image is processed in vertical strips, so narrow that the rows of the integral image under a
/// filter stay in the first-level cache. Rows of responses are kept in a ring buffer that is as
/// long as the 3 x 3 x 3 neighbourhood requires. Only the layers shared with the next octave are
/// stored completely.
class FastHessian {
 public:
  /// Appends the maxima above `threshold` to `maxima`, in no defined order, with angle 0. Octave o
  /// is sampled every min(first_step * 2^o, 4) px; first_step is 1, 2 or 4. Deviation: in the paper
  /// the step keeps doubling; beyond 4 px that saves little time.
  void Detect(const IntegralImage& integral, int octaves, int first_step, float threshold,
              std::vector<SurfKeypoint>* maxima);

 private:
  static constexpr int kLayers = 4;
  struct Plane {
    std::ptrdiff_t stride = 0;
    std::vector<float> values;
  };

  void DetectOctave(const IntegralImage& integral, int octave, int step, bool shares_with_next,
                    int next_step, float threshold, std::vector<SurfKeypoint>* maxima);
  void DetectStrip(const IntegralImage& integral, int octave, int step, bool shares_with_next,
                   int ratio, SampleRange strip, float threshold,
                   std::vector<SurfKeypoint>* maxima);
  void FindMaxima(const IntegralImage& integral, int octave, int step, int sample_y,
                  SampleRange strip, float threshold, std::vector<SurfKeypoint>* maxima);
  float* RingRow(int layer, int sample_y);

  HessianScratch scratch_;
  std::array<std::vector<float>, 3 * kLayers> ring_;
  std::array<Plane, 2> shared_;       ///< Layers 0 and 1 of this octave, from the previous one.
  std::array<Plane, 2> shared_next_;  ///< Layers 1 and 3 of this octave, for the next one.
  std::vector<std::int32_t> candidates_;
};

}  // namespace pleinair::tracker
