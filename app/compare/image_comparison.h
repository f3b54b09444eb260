#pragma once

#include <filesystem>

#include "app/compare/compare_html.h"
#include "app/compare/ground_truth_images.h"
#include "base/error.h"

namespace pleinair::app {

/// Scores the image of a replay's output (or a folder of images) against the ground truth.
/// `jpeg_width_px`: max. width of the JPEG images of ground truth, result and difference; 0: no
/// JPEG. Errors (input): an image or region that is missing, unreadable or of another size.
Result<ComparedPicture> ComparePicture(const std::filesystem::path& pictures,
                                       const GroundTruthImage& of, int jpeg_width_px);

}  // namespace pleinair::app
