#pragma once

#include "base/image.h"

namespace pleinair::accuracy {

// What lens and motion do to light that is known in every pixel. The picture goes on mirrored
// beyond its rim.

/// By a Gaussian of standard deviation `sigma_px`, cut at four of them.
Image<float> GaussianBlurred(const Image<float>& light, double sigma_px);

/// By a disc, each pixel weighted by the share of it that lies within: a lens out of focus.
Image<float> DiscBlurred(const Image<float>& light, double radius_px);

/// Along a streak of a length and direction (rad): motion at constant speed while the shutter is
/// open.
Image<float> StreakBlurred(const Image<float>& light, double length_px, double angle);

}  // namespace pleinair::accuracy
