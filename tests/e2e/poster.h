#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "base/frames.h"

namespace pleinair::e2e {

/// 800×600 grey: overlapping rectangles and ellipses of all sizes, determined by a seed.
cv::Mat Poster(int seed);

/// Pastes a poster over the marker of a frame of the bundled recording. It lies flat on the ground,
/// centred on the marker, with the given width. It has the light of the marker's white margin, with
/// tones from black (4 % reflectance) to white (80 %).
void PastePoster(const cv::Mat& poster, double width_m,
                 const Transform<Camera, Marker>& camera_from_marker, cv::Mat* frame);

}  // namespace pleinair::e2e
