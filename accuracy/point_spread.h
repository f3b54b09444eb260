#pragma once

#include "base/image.h"

namespace pleinair::accuracy {

// Blur by lens and motion of an image with known light in every pixel. The image is mirrored beyond
// its edges.

/// Gaussian of standard deviation `sigma_px`, cut off at four of them.
Image<float> GaussianBlurred(const Image<float>& light, double sigma_px);

/// Disc, with each pixel weighted by its share inside the disc: defocus.
Image<float> DiscBlurred(const Image<float>& light, double radius_px);

/// Streak of a length and direction (rad): motion at constant speed during the exposure.
Image<float> StreakBlurred(const Image<float>& light, double length_px, double angle);

}  // namespace pleinair::accuracy
