#pragma once

#include <filesystem>

#include "app/bench/shadow_bench.h"
#include "base/error.h"

namespace pleinair::app {

/// Writes images of each scene into an existing folder:
/// - `SCENE.jpg`: the view with the ground-truth shadows;
/// - `SCENE_methods.jpg`: the ground truth and all methods side by side, in the window with most
/// penumbra;
/// - `SCENE_errors.jpg`: the error of each method over the whole view, too light (red) or too dark
/// (blue);
/// - `SCENE_METHOD_partitions.jpg`, for methods with several partitions: tinted areas of the
/// partitions, and their maps in the corner.
/// Errors: as WriteError.
Result<void> WriteShadowPictures(const ShadowBenchResult& result,
                                 const std::filesystem::path& folder);

/// Writes `SCENE_error_over_time.svg`: error of the whole image over processor time. It has one
/// line per method through its resolutions; both axes are logarithmic.
Result<void> WriteShadowCharts(const ShadowBenchResult& result,
                               const std::filesystem::path& folder);

}  // namespace pleinair::app
