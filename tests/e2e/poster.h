#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "base/frames.h"

namespace pleinair::e2e {

/// 800×600 grey: rectangles and ellipses of all sizes on one another, after a seed.
cv::Mat Poster(int seed);

/// Pastes a poster over the marker of a frame of the bundled recording: flat on the ground, its
/// centre at the marker's, as wide as said, in the light that the marker's white board shows, its
/// tones from black (4 % reflected) to white (80 %).
void PastePoster(const cv::Mat& poster, double width_m,
                 const Transform<Camera, Marker>& camera_from_marker, cv::Mat* frame);

}  // namespace pleinair::e2e
