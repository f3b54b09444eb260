#pragma once

#include <cstdint>
#include <vector>

#include "base/image.h"

namespace pleinair::tracker {

/// A Gaussian blob of an image made for a test.
struct TestBlob {
  double x, y;      ///< px
  double sigma;     ///< px
  double contrast;  ///< Grey levels above the ground (below it: negative).
};

/// Sum of blobs on a ground of one grey level, rounded to 8 bits.
GreyImage DrawBlobs(int width, int height, double ground, const std::vector<TestBlob>& blobs);

/// A smooth texture without symmetries, a function of the point: many long blobs of random place,
/// size, direction and sign within the square of +-`half` px around the origin, from one seed.
class TestTexture {
 public:
  TestTexture(unsigned seed, double half);
  /// Grey level, around 128.
  double operator()(double x, double y) const;

  /// The texture observed through (x, y) -> angle, zoom: its origin is at the middle of the image.
  GreyImage Draw(int width, int height, double angle_rad, double zoom) const;

 private:
  struct LongBlob {
    double x, y;
    double along_x, along_y;    ///< Unit vector over sigma of the long axis, 1/px.
    double across_x, across_y;  ///< The same of the short axis.
    double contrast;
  };
  std::vector<LongBlob> blobs_;
};

/// Independent pixels, uniform in 0..255.
GreyImage DrawNoise(int width, int height, unsigned seed);

}  // namespace pleinair::tracker
