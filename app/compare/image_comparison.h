#pragma once

#include <filesystem>

#include "app/compare/compare_html.h"
#include "app/compare/ground_truth_images.h"
#include "base/error.h"

namespace pleinair::app {

/// Scores the picture that a replay's output (or a folder of pictures) has against the true one.
/// `jpeg_width_px`: with truth, picture and difference as JPEG, at most so wide; 0: without.
/// Errors (input): a picture or a region that is missing, cannot be read or is of another size.
Result<ComparedPicture> ComparePicture(const std::filesystem::path& pictures,
                                       const GroundTruthImage& of, int jpeg_width_px);

}  // namespace pleinair::app
